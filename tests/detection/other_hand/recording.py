"""Recordings as rvbench reads them."""
import h5py
import numpy as np

from draws import TURN
from unit import OVERSAMPLED, RATE_HZ

ANGLE_RATE_HZ = 1240


def write_recording(path, unit, records, heard):
    with h5py.File(path, "w") as file:
        for number, record in enumerate(records):
            point = file.create_group(f"points/{number:03}")
            point.attrs.update(speed_rpm=float(record.speed_rpm), load_pct=float(record.load_pct), repeat=1,
                               status="ok")
            names = [f"accel_{channel + 1}" for channel in range(len(heard[number]))]
            write_channels(point, "acceleration", heard[number].T, RATE_HZ, names, "m/s²")
            write_channels(point, "angle", angle_rad(unit, record, number)[:, None], ANGLE_RATE_HZ, ["input_angle"],
                           "rad")


def write_channels(point, name, samples, rate_Hz, channels, unit):
    group = point.create_group(name)
    group.create_dataset("data", data=samples.astype(np.float32))
    group.attrs.update(rate_Hz=float(rate_Hz), t0_s=0.0, channels=channels, units=[unit] * len(channels))


def angle_rad(unit, record, number):
    """The input shaft's, from 0, with noise of its encoder."""
    seconds = np.arange(len(record.turns)) / (OVERSAMPLED * RATE_HZ)
    at = np.arange(0, seconds[-1], 1 / ANGLE_RATE_HZ)
    turned = TURN * (np.interp(at, seconds, record.turns) - record.turns[0])
    noise = unit.sitting.stream(f"angle noise at {number}").standard_normal(len(at))
    return turned + unit.angle_noise_rad * noise
