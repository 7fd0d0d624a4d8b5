"""Forces over the angle of the shafts. Angles are in turns, forces in units of no meaning."""
from collections import defaultdict

import numpy as np

from draws import TURN

HARMONICS = 8


class Forces:
    """Samples by the place where they act: of the meshes, of the rest of a sound unit, of damage."""

    def __init__(self):
        self.mesh, self.rest, self.damage = (defaultdict(lambda: 0.0) for _ in range(3))


def act(forces, place, samples, path_turns=None, share=0.0):
    """A force at a place; if the place goes round, its path has a mean, a cosine and a sine part."""
    forces[place] = forces[place] + samples
    if path_turns is not None:
        for part, wave in (("cosine", np.cos), ("sine", np.sin)):
            name = f"{place}, {part}"
            forces[name] = forces[name] + share * samples * wave(TURN * path_turns)


def blows(turns, width_turns, is_gaussian):
    """One blow per turn; it has fallen to 1/e at width_turns on both sides."""
    off = np.abs((turns + 0.5) % 1 - 0.5) / width_turns
    return np.exp(-(off**2)) if is_gaussian else np.exp(-off)


class Mesh:
    """Teeth that pass: HARMONICS harmonics of random decay, the same for each place of contact."""

    def __init__(self, draws, name, copies, gain_spread):
        self.name = name
        ratio = draws.uniform(f"decay of {name}", 0.35, 0.85)
        scatter = np.exp(0.4 * draws.normal(f"harmonics of {name}", HARMONICS))
        self.amplitudes = ratio ** np.arange(HARMONICS) * scatter
        self.phases = draws.phases(f"phases of {name}", HARMONICS)
        self.gains = draws.gains(f"gains of {name}", copies, gain_spread)
        self.rms = float(np.sqrt(0.5 * np.sum(self.amplitudes**2)))

    def force(self, copy, passing, most_harmonics):
        """passing: teeth that have passed the place of contact."""
        step = np.exp(1j * TURN * passing)
        total = np.zeros_like(step)
        for h in reversed(range(min(HARMONICS, most_harmonics))):
            total = (total + self.amplitudes[h] * np.exp(1j * self.phases[h])) * step
        return self.gains[copy] * total.real


class Modulation:
    """What each of two gears does to its mesh in a sound unit: 2 to 10 % together."""

    def __init__(self, draws, name, copies):
        self.depths, self.phases = [], draws.phases(f"modulation of {name}", 2 * copies).reshape(-1, 2)
        shares = draws.stream(f"shares of {name}").random(copies)
        for copy in range(copies):
            depth = draws.uniform(f"healthy modulation of {name} {copy}", 0.02, 0.10)
            self.depths.append((depth * shares[copy], depth * (1 - shares[copy])))

    def swing(self, copy, first_turns, second_turns, first_phase=None):
        """first_phase: of a gear that is the same for every copy."""
        phases = self.phases[copy]
        first = phases[0] if first_phase is None else first_phase
        return (1 + self.depths[copy][0] * np.cos(TURN * first_turns + first)
                + self.depths[copy][1] * np.cos(TURN * second_turns + phases[1]))


class Shaft:
    """Forces at orders 1 and 2, weak in a sound unit."""

    def __init__(self, draws, name, mesh_rms):
        self.sound = [mesh_rms * draws.level(f"order {h} of {name} over mesh", low, high)
                      for h, low, high in ((1, 0.01, 0.1), (2, 0.003, 0.05))]
        self.bent = [mesh_rms * draws.uniform(f"order {h} of bent {name} over mesh", 0.3, 1) for h in (1, 2)]
        self.phases = draws.phases(f"phases of {name}", 4)

    def force(self, turns, severity=None):
        levels, phases = (self.sound, self.phases[:2]) if severity is None else (self.bent, self.phases[2:])
        scale = 1 if severity is None else severity
        return sum(scale * level * np.cos(TURN * h * turns + phase)
                   for h, (level, phase) in enumerate(zip(levels, phases), 1))


class Toothing:
    """A bad profile: the mesh is louder, and the amplitudes of single teeth scatter."""

    def __init__(self, draws, name, teeth):
        self.teeth = draws.normal(f"teeth of {name}", teeth)

    @staticmethod
    def louder(severity):
        return 1 + 1.2 * severity

    def scatter(self, passing, severity):
        """Over the teeth that have passed; it changes smoothly from tooth to tooth."""
        tooth = np.floor(passing).astype(int)
        blend = 0.5 - 0.5 * np.cos(np.pi * (passing - tooth))
        count = len(self.teeth)
        return 0.6 * severity * (self.teeth[tooth % count] * (1 - blend) + self.teeth[(tooth + 1) % count] * blend)


class Race:
    """A spalled race. Blows of 9 times the mean mesh force last one sample at 4 960 Hz."""

    def __init__(self, draws, name, balls, ratio, is_inner):
        self.balls, self.ratio = balls, ratio
        self.order = 0.5 * balls * (1 + ratio if is_inner else 1 - ratio)
        self.slip = draws.uniform(f"slip of {name}", 0.002, 0.015)
        self.jitter = draws.uniform(f"jitter of {name}", 0.002, 0.02)
        self.zone = draws.uniform(f"load zone of {name}", 0.3, 1) if is_inner else 0.0
        self.phase = draws.phases(f"phase of {name}", 1)[0]
        self.draws, self.name = draws, name

    @property
    def blows(self):
        """For each turn of the inner race against the outer one."""
        return self.order * (1 - self.slip)

    def force(self, inner_turns, mean_force, severity, rate_Hz, point):
        """inner_turns: of the inner race against the outer one. point: of the matrix, by number."""
        stream = self.draws.stream(f"blows of {self.name} {point}")
        step = 1 / self.blows
        count = int((inner_turns[-1] - inner_turns[0]) / step * 1.05) + 10
        at = inner_turns[0] + step * (np.cumsum(1 + self.jitter * stream.standard_normal(count)) + stream.random())
        index = np.searchsorted(inner_turns, at)
        width = max(1, round(rate_Hz / 4960))
        inside = index < len(inner_turns) - width
        at, index = at[inside], index[inside]
        zone = (1 - self.zone) + self.zone * np.maximum(0, np.cos(TURN * at + self.phase))
        sizes = 9 * severity * mean_force * np.abs(1 + 0.2 * stream.standard_normal(len(index))) * zone
        samples = np.zeros_like(inner_turns)
        for k in range(width):
            np.add.at(samples, index + k, sizes)
        return samples
