"""The path from forces to sensors: a housing of random modes."""
import numpy as np


def fast_length(least):
    """The next length without a prime factor above 5, of which a Fourier transform is fast."""
    lengths = (2**a * 3**b * 5**c for a in range(3, 22) for b in range(8) for c in range(6))
    return min(length for length in lengths if length >= least)


class Housing:
    """Each mode answers a force by its share in the force's place, each sensor hears its own share."""

    def __init__(self, draws, channels):
        count = draws.whole("housing modes", 6, 40)
        self.draws, self.modes = draws, count
        self.natural_Hz = 50 * (2400 / 50) ** draws.stream("natural frequencies").random(count)
        self.damping = 0.005 * (0.06 / 0.005) ** draws.stream("damping ratios").random(count)
        self.at_sensors = draws.normal("mode shapes at the sensors", channels, count)

    def accelerations(self, forces, rate_Hz):
        """forces: {place: samples}, of one length. Returns channels x samples."""
        samples = np.array(list(forces.values()), dtype=np.float32)
        count = samples.shape[1]
        fast = fast_length(count)
        places = np.array([self.draws.normal(f"mode shapes at {place}", self.modes) for place in forces])
        spectra = np.fft.rfft(samples, fast, axis=1).astype(np.complex64)
        modal = places.T.astype(np.complex64) @ spectra
        frequency_Hz = np.fft.rfftfreq(fast, 1 / rate_Hz)
        for mode in range(self.modes):
            ratio = frequency_Hz / self.natural_Hz[mode]
            modal[mode] *= -(ratio**2) / (1 - ratio**2 + 2j * self.damping[mode] * ratio)
        heard = self.at_sensors.astype(np.complex64) @ modal
        return np.fft.irfft(heard, fast, axis=1)[:, :count]
