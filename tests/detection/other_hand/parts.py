"""The units of each part of the score.

A part has a name, what its units have in common, and a count of each kind. Seeds of a part do not
meet those of another, and the seeds of tuning not those of the score.
"""
from dataclasses import dataclass, field

from machines import PlanetaryStage, RvReducer, TwoStageTrain

KINDS = {"rv20e": tuple(RvReducer.parts), "other_rv": tuple(RvReducer.parts), "other_bearing": ("race",),
         "two_stage": tuple(TwoStageTrain.parts), "planetary": tuple(PlanetaryStage.parts)}
THREE_POINTS = ((605, 100), (1210, 100), (1815, 100))
NINE_POINTS = tuple((rpm, load) for rpm in (605, 1210, 1815) for load in (50, 100, 150))
TUNING, SCORE = 0, 10_000_000  # where seeds begin


@dataclass
class Specimen:
    part: str
    number: int
    seed: int
    machine: str = "rv20e"
    planets: int = 2
    damages: dict = field(default_factory=dict)
    sitting: int = 0
    points: tuple = THREE_POINTS
    changes: dict = field(default_factory=dict)  # of what the sensors hear

    @property
    def id(self):
        return f"{self.part}-{self.number:04}"


def first_line(severity=1.0, healthy=100, each=30, machine="rv20e", **more):
    """Healthy units, then as many of each kind of damage."""
    def of(part, first_seed):
        damages = [{}] * healthy + [{kind: severity} for kind in KINDS[machine] for _ in range(each)]
        return [Specimen(part, n, first_seed + n, machine=machine, damages=d, **more) for n, d in enumerate(damages)]
    return of


def pairs(part, first_seed):
    kinds = KINDS["rv20e"]
    two = [(a, b) for i, a in enumerate(kinds) for b in kinds[i + 1:] if (a, b) != ("shaft", "sun")]
    return [Specimen(part, n, first_seed + n, planets=2 + n % 2, damages=dict.fromkeys(two[n % len(two)], 1.0))
            for n in range(100)]


def half_and_half(count, **changes):
    """As many faulty units, of each kind in turn, as healthy ones."""
    def of(part, first_seed):
        kinds = KINDS["rv20e"]
        return [Specimen(part, n, first_seed + n, planets=2 + n % 2, changes=changes,
                         damages={} if n % 2 else {kinds[n // 2 % 5]: 1.0}) for n in range(count)]
    return of


def faulty(count, machine="rv20e", **changes):
    """Each kind in turn, once with two planets and once with three."""
    def of(part, first_seed):
        kinds = KINDS[machine]
        return [Specimen(part, n, first_seed + n, machine=machine, planets=2 + n // len(kinds) % 2, changes=changes,
                         damages={kinds[n % len(kinds)]: 1.0}) for n in range(count)]
    return of


PARTS = {
    "two_planets": first_line(planets=2),
    "three_planets": first_line(planets=3),
    "two_planets_half": first_line(0.5, healthy=0, planets=2),
    "three_planets_half": first_line(0.5, healthy=0, planets=3),
    "other_bearing": faulty(60, machine="other_bearing"),
    "other_rv": first_line(healthy=60, each=20, machine="other_rv"),
    "two_stage": first_line(healthy=60, each=20, machine="two_stage"),
    "planetary": first_line(healthy=60, each=20, machine="planetary"),
    "pairs": pairs,
    "hum": half_and_half(100, hum=1.0),
    "tone": half_and_half(100, tone=1.0),
    "loud_noise": half_and_half(100, noise_scale=4.0),
    "white_half": faulty(80, white=0.5),
    "white_one": faulty(80, white=1.0),
    "white_two": faulty(80, white=2.0),
    "white_four": faulty(80, white=4.0),
    "angle_noise": half_and_half(50, angle_noise_rad=0.003),
    "dead_channel": half_and_half(100, dead_channel=True),
    "clipped_channel": half_and_half(100, clipped_channel=True),
    "nine_points": first_line(healthy=20, each=8, planets=2, points=NINE_POINTS),
}


def specimens(part, base):
    return PARTS[part](part, base + 100_000 * list(PARTS).index(part) + 1)
