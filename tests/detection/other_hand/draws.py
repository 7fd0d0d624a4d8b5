"""Random properties of a unit, each from a stream of its own and kept under its name."""
import zlib

import numpy as np

TURN = 2 * np.pi


class Draws:
    """A value depends on the seed and its name alone, not on what else is drawn."""

    def __init__(self, *seed):
        self.seed = [int(number) for number in seed]
        self.drawn = {}

    def stream(self, name):
        return np.random.default_rng([*self.seed, zlib.crc32(name.encode())])

    def uniform(self, name, low, high):
        return self._keep(name, float(self.stream(name).uniform(low, high)))

    def level(self, name, low, high):
        """Uniform on a logarithmic scale."""
        return self._keep(name, float(low * (high / low) ** self.stream(name).random()))

    def whole(self, name, low, high):
        """A whole number; both ends are possible."""
        return self._keep(name, int(self.stream(name).integers(low, high, endpoint=True)))

    def phases(self, name, count):
        return TURN * self.stream(name).random(count)

    def gains(self, name, count, spread):
        """Numbers within 1 +- spread."""
        return self.stream(name).uniform(1 - spread, 1 + spread, count)

    def normal(self, name, *shape):
        return self.stream(name).standard_normal(shape)

    def _keep(self, name, value):
        self.drawn[name] = value
        return value
