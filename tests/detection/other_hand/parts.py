"""The units of each part of the score.

A part has a name, what its units have in common, and a count of each kind. Its seeds do not meet those of
another part, but where it asks of another part's units again. Seeds of tuning are not those of the score.
"""
from dataclasses import dataclass, field, replace

from machines import PlanetaryStage, RvReducer, TwoStageTrain

KINDS = {"rv20e": tuple(RvReducer.parts), "other_rv": tuple(RvReducer.parts), "other_bearing": ("race",),
         "two_stage": tuple(TwoStageTrain.parts), "planetary": tuple(PlanetaryStage.parts)}
THREE_POINTS = ((605, 100), (1210, 100), (1815, 100))
NINE_POINTS = tuple((rpm, load) for rpm in (605, 1210, 1815) for load in (50, 100, 150))
TUNING, SCORE, SHORT = 0, 10_000_000, 20_000_000  # where seeds begin
OF_SOUND_UNITS = 5_000_000  # further
FIRST_LINE = ("two_planets", "three_planets")  # parts


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
    def of(part, base):
        damages = [{}] * healthy + [{kind: severity} for kind in KINDS[machine] for _ in range(each)]
        seed = first_seed(part, base)
        return [Specimen(part, n, seed + n, machine=machine, damages=d, **more) for n, d in enumerate(damages)]
    return of


def again(every, **changes):
    """One unit in so many of the first line, with a change."""
    def of(part, base):
        units = [unit for first in FIRST_LINE for unit in specimens(first, base)[::every]]
        return [replace(unit, part=part, number=n, changes=changes) for n, unit in enumerate(units)]
    return of


def with_sensors(channels):
    """Units of the first line with two planets, 100 healthy and 20 of each kind, by so many sensors."""
    def of(part, base):
        units = [unit for unit in specimens("two_planets", base) if unit.number < 100 or (unit.number - 100) % 30 < 20]
        return [replace(unit, part=part, number=n, changes={"channels": channels}) for n, unit in enumerate(units)]
    return of


def pairs(part, base):
    seed = first_seed(part, base)
    kinds = KINDS["rv20e"]
    two = [(a, b) for i, a in enumerate(kinds) for b in kinds[i + 1:] if (a, b) != ("shaft", "sun")]
    return [Specimen(part, n, seed + n, planets=2 + n % 2, damages=dict.fromkeys(two[n % len(two)], 1.0))
            for n in range(100)]


def half_and_half(count, **changes):
    """As many faulty units, of each kind in turn, as healthy ones."""
    def of(part, base):
        kinds, seed = KINDS["rv20e"], first_seed(part, base)
        return [Specimen(part, n, seed + n, planets=2 + n // 2 % 2, changes=changes,
                         damages={} if n % 2 else {kinds[n // 2 % 5]: 1.0}) for n in range(count)]
    return of


def faulty(count, machine="rv20e", **changes):
    """Each kind in turn, once with two planets and once with three."""
    def of(part, base):
        kinds, seed = KINDS[machine], first_seed(part, base)
        return [Specimen(part, n, seed + n, machine=machine, planets=2 + n // len(kinds) % 2, changes=changes,
                         damages={kinds[n % len(kinds)]: 1.0}) for n in range(count)]
    return of


def remounted(part, base):
    """Each unit twice: with other noise the second time, and its sensors mounted anew."""
    kinds, seed = KINDS["rv20e"], first_seed(part, base)
    return [Specimen(part, n, seed + n // 2, planets=2 + n // 4 % 2, sitting=n % 2,
                     damages={} if n // 2 % 2 else {kinds[n // 4 % 5]: 1.0}) for n in range(200)]


def visible(low, high):
    """Damage of so many times what the sound record says would be seen."""
    def of(part, base):
        kinds, seed = KINDS["rv20e"], first_seed(part, base)
        return [Specimen(part, n, seed + n, planets=2 + n // 5 % 2, damages={kinds[n % 5]: 1.0},
                         changes={"times_visible": low + (high - low) * n / 199}) for n in range(200)]
    return of


def sound_units(machine, planets, base):
    """Twenty of other housings than any part has."""
    first = base + OF_SOUND_UNITS + 100 * (list(KINDS).index(machine) * 10 + planets)
    return [Specimen("sound", n, first + n, machine=machine, planets=planets) for n in range(20)]


def short_units(base):
    """Of each machine two sound units and four bad ones, one of the RV-20E for each number of planets."""
    units = []
    for machine, planets in (("rv20e", 2), ("rv20e", 3), ("two_stage", 2), ("planetary", 2)):
        for n, kind in enumerate(("", "", *KINDS[machine][:4])):
            number = len(units)
            units.append(Specimen("short", number, base + number + 1, machine=machine, planets=planets,
                                  damages={kind: 1.0} if kind else {}))
    return units


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
    "angle_noise": again(10, angle_noise_rad=0.003),
    "dead_channel": again(5, dead_channel=True),
    "clipped_channel": again(5, clipped_channel=True),
    "remounted": remounted,
    "above_visible": visible(1.0, 1.5),
    "below_visible": visible(0.4, 0.6),
    "two_planets_quarter": first_line(0.25, healthy=0, planets=2),
    "three_planets_quarter": first_line(0.25, healthy=0, planets=3),
    "six_sensors": with_sensors(6),
    "three_sensors": with_sensors(3),
    "one_sensor": with_sensors(1),
    "nine_points": first_line(healthy=20, each=8, planets=2, points=NINE_POINTS),
}


def first_seed(part, base):
    return base + 100_000 * list(PARTS).index(part) + 1


def specimens(part, base):
    return PARTS[part](part, base)
