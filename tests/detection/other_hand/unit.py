"""A unit on a bench: its forces through its housing, and what else the sensors hear."""
import numpy as np

from draws import TURN, Draws
from housing import Housing, fast_length

RATE_HZ = 4960
OVERSAMPLED = 2
LEAD_S = 1.0  # the housing has settled by then


class Record:
    """One point of the matrix. Arrays are channels x samples at RATE_HZ."""

    def __init__(self, speed_rpm, load_pct, mesh, rest, damage, noise, turns):
        self.speed_rpm, self.load_pct = speed_rpm, load_pct
        self.mesh, self.rest, self.damage, self.noise = mesh, rest, damage, noise
        self.turns = turns

    def heard(self):
        return self.mesh + self.rest + self.damage + self.noise


class Unit:
    """seed: of the unit; sitting: of noise, speed and how the sensors are mounted."""

    def __init__(self, machine, seed, sitting=0, channels=12):
        self.draws, self.sitting = Draws(seed), Draws(seed, 1 + sitting)
        self.housing = Housing(self.draws, channels)
        self.machine = machine(self.draws)
        self.load_exponent = self.draws.uniform("exponent of the load", 0.4, 1.2)
        self.slip = self.draws.uniform("slip of the motor", 0, 0.03)
        self.pole_pairs = self.draws.whole("pole pairs", 1, 2)
        self.noise = self.draws.level("noise over signal", 0.02, 0.5)
        self.colour = self.draws.uniform("noise falls with frequency to the power of", 0, 1)
        self.hum = self.draws.level("hum over signal", 0.002, 0.1)
        self.inverter = self.draws.level("inverter lines over signal", 0.002, 0.1)
        self.neighbour = self.draws.level("neighbour's tones over signal", 0.002, 0.1)
        self.neighbour_Hz = 20 * (2000 / 20) ** self.draws.stream("neighbour").random(3)
        self.angle_noise_rad = self.draws.level("noise on the angle", 1e-5, 3e-3)
        self.mounted = 1.0 if sitting == 0 else self.sitting.gains("sensors", channels, 0.1)[:, None]

    def record(self, point, speed_rpm, load_pct, damages, noise_scale=1.0):
        fine_Hz = OVERSAMPLED * RATE_HZ
        turns, speed_Hz = self.angle(point, speed_rpm, fine_Hz)
        size = (load_pct / 100) ** self.load_exponent
        forces = self.machine.forces(turns, speed_Hz, size, fine_Hz, point, damages)
        mesh, rest, damage = (self.heard(part, fine_Hz, len(turns)) for part in
                              (forces.mesh, forces.rest, forces.damage))
        seconds = np.arange(mesh.shape[1]) / RATE_HZ
        level = float(np.sqrt(np.mean((mesh + rest) ** 2)))
        rest = rest + self.mounted * level * self.tones(seconds, speed_Hz)
        noise = noise_scale * self.noise * level * self.coloured(point, mesh.shape)
        return Record(speed_rpm, load_pct, mesh, rest, damage, noise, turns[int(LEAD_S * fine_Hz):])

    def angle(self, point, speed_rpm, rate_Hz):
        """Turns of the input shaft: below the nominal speed by the slip, and never quite steady."""
        stream = self.sitting.stream(f"wander at {point}")
        mean_Hz = speed_rpm / 60 * (1 - self.slip)
        count = int(LEAD_S * rate_Hz) + fast_length(max(8.0, 1.01 * self.machine.record_turns / mean_Hz) * rate_Hz)
        seconds = np.arange(count) / rate_Hz
        wander = stream.uniform(0.0003, 0.003)
        speed_Hz = np.full(count, mean_Hz)
        for _ in range(4):
            speed_Hz *= 1 + wander / 2 * np.cos(TURN * stream.uniform(0.05, 0.5) * seconds + TURN * stream.random())
        return np.cumsum(speed_Hz) / rate_Hz + stream.random() * 1000, mean_Hz

    def heard(self, forces, rate_Hz, count):
        if not forces:
            kept = (count - int(LEAD_S * rate_Hz)) // OVERSAMPLED
            return np.zeros((self.housing.at_sensors.shape[0], kept), dtype=np.float32)
        fine = self.housing.accelerations(forces, rate_Hz)
        fine = fine[:, int(LEAD_S * rate_Hz):]
        spectra = np.fft.rfft(fine, axis=1)
        kept = fine.shape[1] // OVERSAMPLED
        passed = 1 / (1 + (np.fft.rfftfreq(fine.shape[1], 1 / rate_Hz) / (0.45 * RATE_HZ)) ** 24)
        return self.mounted * np.fft.irfft((spectra * passed)[:, : kept // 2 + 1], kept, axis=1) / OVERSAMPLED

    def tones(self, seconds, speed_Hz):
        """Of the mains, the inverter and a neighbour; each channel hears its own share of each."""
        stream = self.draws.stream("tones")
        supply_Hz = speed_Hz / (1 - self.slip) * self.pole_pairs
        lines = [(self.hum, 50.0), (0.5 * self.hum, 100.0), (self.inverter, 2 * supply_Hz),
                 (0.5 * self.inverter, 6 * supply_Hz)]
        lines += [(self.neighbour / (1 + k), hz) for k, hz in enumerate(self.neighbour_Hz)]
        total = 0
        for level, frequency_Hz in lines:
            share = stream.standard_normal((self.housing.at_sensors.shape[0], 1))
            wave = np.cos(TURN * frequency_Hz * seconds + TURN * stream.random())
            total = total + np.sqrt(2) * level * share * wave
        return total

    def coloured(self, point, shape):
        white = self.sitting.stream(f"noise at {point}").standard_normal(shape, dtype=np.float32)
        spectrum = np.fft.rfft(white, axis=1)
        frequency_Hz = np.fft.rfftfreq(shape[1], 1 / RATE_HZ)
        filter_ = (np.maximum(frequency_Hz, 20) / 100) ** (-self.colour / 2)
        filter_ /= np.sqrt(np.mean(filter_**2))
        return np.fft.irfft(spectrum * filter_, shape[1], axis=1)
