"""The table of a slide: the force at each moment, over laws of its way and speed."""
import json

import numpy as np

from table import Table

EDGE = 40  # samples, at either end
SMOOTHING = 15  # samples: what noise of a way leaves of an acceleration
EACH = 6  # so many-th sample is kept
NEARLY_AT_REST = 0.01  # of the fastest speed
HALF_WINDOW = 9


def derivatives(x, rate_Hz):
    """First and second, by a polynomial of the fourth power (Savitzky & Golay 1964)."""
    t = np.arange(-HALF_WINDOW, HALF_WINDOW + 1) / rate_Hz
    weights = np.linalg.pinv(np.vander(t, 5, increasing=True))
    return (np.convolve(x, weights[1][::-1], "same"), 2 * np.convolve(x, weights[2][::-1], "same"))


def smooth(x):
    window = np.hanning(SMOOTHING + 2)[1:-1]
    return np.convolve(x, window / window.sum(), "same")[EDGE:-EDGE][::EACH]


def laws(way, speed):
    """What may push against a motion, at a size of about one."""
    q, v = way / np.max(np.abs(way)), speed / np.max(np.abs(speed))
    side = np.tanh(v / NEARLY_AT_REST)
    gap = np.quantile(np.abs(q), 0.3)
    return {
        "viscous_friction": [v],
        "coulomb_friction": [side],
        "asymmetric_friction": [np.maximum(side, 0)],
        "stribeck_friction": [side * np.exp(-((v / 0.1) ** 2))],
        "shear_thinning": [side * np.abs(v) ** 0.5],
        "nonlinear_damping": [v * np.abs(v), q * q * v],
        "stiffness_hysteresis": [side * np.abs(q)],
        "quadratic_stiffness": [q * q],
        "cubic_stiffness": [q**3],
        "looseness": [np.sign(q) * np.maximum(np.abs(q) - gap, 0)],
    }


def slide_table(folder):
    campaign = json.loads((folder / "campaign.json").read_text())
    plant = json.loads((folder / "plant.json").read_text())
    moved = plant["inputs"][0]["is"] == "position"
    has = {term["type"] for term in plant["terms"]}
    records = []
    for file in campaign["files"]:
        data = np.loadtxt(folder / file["file"], delimiter=",", skiprows=1)
        way, force = (data[:, 0], data[:, 1]) if moved else (data[:, 1], data[:, 0])
        speed, acceleration = derivatives(way, file["rate_Hz"])
        records.append((file["records"][0]["condition"], way, speed, acceleration, force))
    way, speed = (np.concatenate([r[i] for r in records]) for i in (1, 2))
    ends = np.cumsum([r[1].size for r in records])[:-1]
    tried = {name: [np.split(column, ends) for column in columns]
             for name, columns in laws(way, speed).items() if name not in has}
    base = [[r[3], np.ones_like(r[1])] for r in records]
    for columns, record in zip(base, records):
        if "viscous_friction" in has or not moved:
            columns.append(record[2])
        if not moved:
            columns.append(record[1])
    stack = lambda parts: np.column_stack([smooth(part) for part in parts])
    return Table(
        np.concatenate([smooth(r[4]) for r in records]),
        np.concatenate([stack(columns) for columns in base]),
        {name: np.concatenate([stack([column[i] for column in columns])
                               for i in range(len(records))])
         for name, columns in tried.items()},
        np.concatenate([np.full(smooth(r[1]).size, r[0], dtype=object) for r in records]),
        np.concatenate([stack([r[1], r[2]]) for r in records]))
