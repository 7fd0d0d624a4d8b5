"""The units of each part of the score.

A part has a name, what its units have in common, and a count of each kind. Seeds of a part do not
meet those of another, and the seeds of tuning not those of the score.
"""
from dataclasses import dataclass, field

KINDS = {"rv20e": ("shaft", "sun", "tooth", "pin", "race"), "other_rv": ("shaft", "sun", "tooth", "pin", "race"),
         "two_stage": ("shaft", "wheel", "tooth", "last", "race"),
         "planetary": ("shaft", "sun", "tooth", "ring", "race")}
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


def first_line(name, planets, severity=1.0, healthy=100, each=30, **more):
    """Healthy units, then as many of each kind of damage."""
    def of(first_seed):
        damages = [{}] * healthy + [{kind: severity} for kind in KINDS["rv20e"] for _ in range(each)]
        return [Specimen(name, n, first_seed + n, planets=planets, damages=d, **more) for n, d in enumerate(damages)]
    return of


def of_machine(name, healthy=60, each=20):
    def of(first_seed):
        damages = [{}] * healthy + [{kind: 1.0} for kind in KINDS[name] for _ in range(each)]
        return [Specimen(name, n, first_seed + n, machine=name, damages=d) for n, d in enumerate(damages)]
    return of


def pairs(first_seed):
    kinds = KINDS["rv20e"]
    two = [(a, b) for i, a in enumerate(kinds) for b in kinds[i + 1:] if (a, b) != ("shaft", "sun")]
    return [Specimen("pairs", n, first_seed + n, planets=2 + n % 2, damages=dict.fromkeys(two[n % len(two)], 1.0))
            for n in range(100)]


def half_and_half(name, count, **changes):
    """As many faulty units, of each kind in turn, as healthy ones."""
    def of(first_seed):
        kinds = KINDS["rv20e"]
        return [Specimen(name, n, first_seed + n, planets=2 + n % 2, changes=changes,
                         damages={} if n % 2 else {kinds[n // 2 % 5]: 1.0}) for n in range(count)]
    return of


def faulty(name, count, **changes):
    def of(first_seed):
        return [Specimen(name, n, first_seed + n, planets=2 + n // 5 % 2, changes=changes,
                         damages={KINDS["rv20e"][n % 5]: 1.0}) for n in range(count)]
    return of


PARTS = {
    "two_planets": first_line("two_planets", 2),
    "three_planets": first_line("three_planets", 3),
    "two_planets_half": first_line("two_planets_half", 2, 0.5, healthy=0),
    "three_planets_half": first_line("three_planets_half", 3, 0.5, healthy=0),
    "other_bearing": lambda seed: [Specimen("other_bearing", n, seed + n, machine="other_bearing", planets=2 + n % 2,
                                            damages={"race": 1.0}) for n in range(60)],
    "other_rv": of_machine("other_rv"),
    "two_stage": of_machine("two_stage"),
    "planetary": of_machine("planetary"),
    "pairs": pairs,
    "hum": half_and_half("hum", 100, hum=1.0),
    "tone": half_and_half("tone", 100, tone=1.0),
    "loud_noise": half_and_half("loud_noise", 100, noise_scale=4.0),
    "white_half": faulty("white_half", 80, white=0.5),
    "white_one": faulty("white_one", 80, white=1.0),
    "white_two": faulty("white_two", 80, white=2.0),
    "white_four": faulty("white_four", 80, white=4.0),
    "angle_noise": half_and_half("angle_noise", 50, angle_noise_rad=0.003),
    "dead_channel": half_and_half("dead_channel", 100, dead_channel=True),
    "clipped_channel": half_and_half("clipped_channel", 100, clipped_channel=True),
    "nine_points": first_line("nine_points", 2, healthy=20, each=8, points=NINE_POINTS),
}


def specimens(part, base):
    return PARTS[part](base + 100_000 * list(PARTS).index(part) + 1)
