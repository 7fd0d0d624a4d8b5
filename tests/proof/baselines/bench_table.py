"""The table of a bench: how far each line of the torque stands out of its noise, over masks of
where effects have theirs. Nothing is simulated: the plant's own lines are its base."""
import json

import h5py
import numpy as np

from table import Table

TURNS = 121  # of the input shaft per period
PER_TURN = 32
HIGHEST = TURNS * 15
BESIDE = 12  # orders to each side that tell the noise
LARGEST = 30.0  # a line that stands out more tells no more
MAINS_HZ = (50.0, 100.0)
SUPPLY = (1, 2, 6, 12)


def order_power(torque, angle):
    """Of each multiple of 1/121 order, over whole periods, under a Hann window."""
    periods = int((angle[-1] - angle[0]) / (2 * np.pi * TURNS))
    count = periods * TURNS * PER_TURN
    even = np.interp(angle[0] + 2 * np.pi * np.arange(count) / PER_TURN, angle, torque)
    spectrum = np.fft.rfft((even - even.mean()) * np.hanning(count))
    return np.abs(spectrum[periods * np.arange(HIGHEST + 1)]) ** 2


def timed_power(torque, rate_Hz, frequency_Hz):
    """Of one frequency, and of those beside it."""
    count = torque.size
    t = np.arange(count) / rate_Hz
    windowed = (torque - torque.mean()) * np.hanning(count)
    power = lambda f: np.abs(np.dot(windowed, np.exp(-2j * np.pi * f * t))) ** 2
    beside = [power(frequency_Hz + side * k * rate_Hz / count)
              for k in (4, 5, 6, 7) for side in (-1, 1)]
    return power(frequency_Hz), np.median(beside) / np.log(2)


def standing_out(power, noise, repeats):
    """Standard errors of a mean of exponential values."""
    return np.minimum((power / noise - 1) * np.sqrt(repeats), LARGEST)


def noise_beside(power):
    padded = np.pad(power, BESIDE, mode="reflect")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 2 * BESIDE + 1)
    return np.median(windows, axis=1) / np.log(2)


def orders_of(plant):
    """Multiples of 1/121 that effects have their lines at: kinematics, as in the plant file."""
    terms = {term["name"]: term["parameters"] for term in plant["terms"]}
    teeth = round(terms["mesh_1"]["sun_teeth"]["value"])
    pins = round(terms["stage_1"]["pins"]["value"])
    crank, mesh = pins - 1, teeth * (TURNS - 1)
    return {
        "pin_ripple": [pins * crank],
        "crank_eccentricity": [crank, 2 * crank, pins],
        "gear_eccentricity": [pins],
        "tooth_damage": [pins * k for k in range(1, HIGHEST // pins + 1)],
        "misalignment": [2 * TURNS, 4 * TURNS],
        "brake_ripple": [1, 2],
        "transmission_error": [mesh],
        "mesh_stiffness_variation": [mesh],
    }


def bench_table(folder):
    plant = json.loads((folder / "plant.json").read_text())
    orders, timed, counts, supply_Hz = {}, {}, {}, {}
    with h5py.File(folder / "recording.h5") as file:
        for name, point in file["points"].items():
            if not isinstance(point, h5py.Group):
                continue
            key = (point.attrs["speed_rpm"], point.attrs["load_pct"])
            torque, angle = (point[part]["data"][:, 0] for part in ("torque", "angle"))
            rate_Hz = point["torque"].attrs["rate_Hz"]
            supply_Hz[key] = key[0] / 60 * 2
            counts[key] = counts.get(key, 0) + 1
            orders[key] = orders.get(key, 0) + order_power(torque, angle)
            shaft_Hz = (angle[-1] - angle[0]) / (2 * np.pi) / (angle.size - 1) * rate_Hz
            slip_Hz = 2 * (supply_Hz[key] - 2 * shaft_Hz)
            places = [*MAINS_HZ, *(k * supply_Hz[key] for k in SUPPLY), slip_Hz]
            lines = np.array([timed_power(torque, rate_Hz, f) for f in places])
            timed[key] = timed.get(key, 0) + lines
    known = orders_of(plant)
    masks = {name: np.isin(np.arange(1, HIGHEST + 1), places) for name, places in known.items()}
    named_times = {"external_force": [0, 1], "mains_hum": [0, 1], "inverter_ripple": [4],
                   "rotor_bar": [6]}
    of_timed = len(MAINS_HZ) + len(SUPPLY) + 1
    y, condition, states = [], [], []
    for key in orders:
        mean = orders[key] / counts[key]
        y.append(standing_out(mean, noise_beside(mean), counts[key])[1:])
        lines = timed[key] / counts[key]
        y.append(standing_out(lines[:, 0], lines[:, 1], counts[key]))
        condition += [f"{key}"] * (HIGHEST + of_timed)
        states.append(np.column_stack([np.arange(HIGHEST + of_timed) / HIGHEST,
                                       np.full(HIGHEST + of_timed, key[0] / 1815),
                                       np.full(HIGHEST + of_timed, key[1] / 150)]))
    row = lambda own, times: np.concatenate([own, np.isin(np.arange(of_timed), times)])
    nothing = np.zeros(HIGHEST, bool)
    library = {name: row(mask, []) for name, mask in masks.items()}
    library |= {name: row(nothing, times) for name, times in named_times.items()}
    has = {"transmission_error": "profile_error", "mesh_stiffness_variation": "stiffness_ripple"}
    mesh = next(t for t in plant["terms"] if t["name"] == "mesh_1")["parameters"]
    motor = next(t for t in plant["terms"] if t["type"] == "induction_motor")["parameters"]
    known = [name for name, key in has.items() if key in mesh]
    known += ["inverter_ripple"] if "ripple" in motor else []
    own = [library.pop(name) for name in known]
    repeat = lambda mask: np.tile(mask.astype(float), len(orders))[:, None]
    base = [np.ones(len(condition))[:, None], *(repeat(mask) for mask in own)]
    return Table(np.concatenate(y), np.column_stack(base),
                 {name: repeat(mask) for name, mask in library.items()},
                 np.array(condition, dtype=object), np.concatenate(states))
