"""Plain methods, to stand beside rvbench. Each gives a number for each part of an RV-20E.

`STATISTICS` maps a method's name to a function of a recording's points. What a method calls a fault is
decided in counting.py, from its numbers on sound units of the tuning seeds.
"""
import h5py
import numpy as np

from draws import TURN
from housing import fast_length

OUTPUT_TURNS, INPUT_TURNS = 4, 484  # of the RV-20E, i = 121
PER_TURN = 64  # samples
MESH, PIN_PASS = 1080, 1560  # in turns of the output
HARMONICS = 4
INNER_RACE = 40 / 121 * 0.5 * 11 * (1 + 5 / 26)
# By Table 4 of the article: harmonics of the envelope that are asked for each part.
ENVELOPE_ORDERS = {
    "input_shaft": [1, 2],
    "sun_gear": [120 / 121 * h for h in range(1, 5)],
    "planet_gear": [40 / 121 * h for h in (1, 2, 4, 5)],  # each third one is the sun's
    "pin_housing": [39 / 121 * h for h in range(1, 5)],
    "bearing_inner": [INNER_RACE * h for h in range(1, 5)],
}
SLIPS = np.linspace(0, 0.02, 21)


def points_of(path):
    """(channels x samples, turns of the input shaft at each sample) of each point."""
    with h5py.File(path) as file:
        for point in file["points"].values():
            vibration = point["acceleration/data"][()].T.astype(float)
            rate_Hz = point["acceleration"].attrs["rate_Hz"]
            angle, angle_Hz = point["angle/data"][:, 0] / TURN, point["angle"].attrs["rate_Hz"]
            seconds = np.arange(vibration.shape[1]) / rate_Hz
            known = seconds <= (len(angle) - 1) / angle_Hz
            yield vibration[:, known], np.interp(seconds[known], np.arange(len(angle)) / angle_Hz, angle)


def over_angle(samples, turns):
    """Resampled by linear interpolation over INPUT_TURNS."""
    at = turns[0] + np.arange(INPUT_TURNS * PER_TURN) / PER_TURN
    return np.interp(at, turns, samples)


def over_floor(even, reach=40):
    """ln of the power of each order k / INPUT_TURNS, or of a larger neighbour's, over the mean ln around it."""
    powers = np.abs(np.fft.rfft((even - even.mean()) * np.hanning(len(even)))) ** 2
    of = np.log(np.maximum(powers, 1e-300))
    sums = np.concatenate([[0], np.cumsum(np.pad(of, reach, mode="edge"))])
    around = (sums[2 * reach + 1 :] - sums[: -2 * reach - 1]) / (2 * reach + 1)
    return np.maximum(of, np.maximum(np.roll(of, 1), np.roll(of, -1))) - around


def comb(lines_over_floor, part):
    """The mean over a part's lines; blows are searched over slips."""
    slips = SLIPS if part == "bearing_inner" else np.zeros(1)
    lines = np.outer(1 - slips, ENVELOPE_ORDERS[part]) * INPUT_TURNS
    return float(lines_over_floor[np.rint(lines).astype(int)].mean(axis=1).max())


def envelope_statistics(squared_envelope, turns):
    lines = over_floor(over_angle(squared_envelope, turns))
    return {part: comb(lines, part) for part in ENVELOPE_ORDERS}


def banded(spectrum, low, high, count):
    """The analytic signal of a band of the spectrum, at as few samples as hold it."""
    band = spectrum[low:high]
    return np.fft.ifft(band * np.hanning(len(band)), len(band)) * (len(band) / count)


def loudest_kurtosis(samples):
    """Squared envelope of the band where it is most peaked: of 4, 8, 16 and 32 equal bands."""
    count = fast_length(len(samples))
    spectrum = np.fft.rfft(samples, count)
    best, chosen = -np.inf, None
    for bands in (4, 8, 16, 32):
        edges = np.linspace(0, len(spectrum), bands + 1).astype(int)
        for low, high in zip(edges[:-1], edges[1:]):
            squared = np.abs(banded(spectrum, low, high, count)) ** 2
            kurtosis = np.mean(squared**2) / np.mean(squared) ** 2 - 2
            if kurtosis > best:
                best, chosen = kurtosis, squared
    return np.interp(np.arange(len(samples)), np.arange(len(chosen)) * (count / len(chosen)), chosen)


def kurtosis_band(samples, turns):
    return envelope_statistics(loudest_kurtosis(samples), turns)


def prewhitened(samples, turns):
    """Cepstrum prewhitening (Borghesani et al., MSSP 36, 2013): every line has the same amplitude."""
    count = fast_length(len(samples))
    spectrum = np.fft.rfft(samples, count)
    white = np.fft.irfft(spectrum / np.maximum(np.abs(spectrum), 1e-12 * np.abs(spectrum).max()), count)
    return envelope_statistics(white[: len(samples)] ** 2, turns)


def near(number, others):
    return any(abs(number - other) <= 1 for other in others)


def own_lines():
    """Lines k/121 that no sound part gives, by part; within 1 the carrier's turn moves them."""
    healthy = [c * h + side for c in (MESH, PIN_PASS) for h in range(1, 9) for side in (-120, -40, -39, 0, 39, 40, 120)]
    of_pins = range(0, 4000, 39)
    lines = {"sun_gear": (range(240, 4000, 120), of_pins),
             "planet_gear": (range(40, 4000, 40), [*of_pins, *range(0, 4000, 120)]),
             "pin_housing": (of_pins, range(0, 4000, 40))}
    return {part: [k for k in own if not near(k, healthy) and not near(k, foreign)]
            for part, (own, foreign) in lines.items()}


OWN_LINES = own_lines()
# A bent shaft swings each planet's mesh; the path turns with the carrier. Sound ones swing it less.
OWN_LINES["input_shaft"] = [MESH * h + side for h in range(1, 9) for side in (-121, -120, -119, 119, 120, 121)]
MESH_LINES = [MESH * h + side for h in range(1, 9) for side in (-1, 0, 1)]


def own_line_rule(samples, turns):
    """Amplitude of each part's own lines over the mesh's; for the race, what is left without the k/121."""
    even = over_angle(samples, turns)
    spectrum = np.fft.rfft(even)
    powers = np.abs(spectrum) ** 2
    top = len(powers) // OUTPUT_TURNS - 1
    between = np.convolve(powers[OUTPUT_TURNS // 2 :: OUTPUT_TURNS], np.full(10, 0.1), mode="same")

    def above(lines):
        inside = np.array([k for k in lines if k < top])
        return max(0.0, float(np.sum(powers[OUTPUT_TURNS * inside] - between[inside])))
    mesh = above(MESH_LINES)
    found = {part: np.sqrt(above(lines) / mesh) if mesh > 0 else 0.0 for part, lines in OWN_LINES.items()}
    spectrum[::OUTPUT_TURNS] = 0
    found["bearing_inner"] = comb(over_floor(np.fft.irfft(spectrum, len(even)) ** 2), "bearing_inner")
    return found


PLAIN = {"envelope in the band of highest kurtosis": kurtosis_band, "cepstrum prewhitening": prewhitened,
         "own lines": own_line_rule}


def plain_statistics(path):
    """{method: {part: statistic}}, each the median over channels, then the mean over points."""
    found = {method: {} for method in PLAIN}
    for vibration, turns in points_of(path):
        for method, of_channel in PLAIN.items():
            of_channels = [of_channel(samples, turns) for samples in vibration]
            for part in of_channels[0]:
                found[method].setdefault(part, []).append(np.median([of[part] for of in of_channels]))
    return {method: {part: float(np.mean(values)) for part, values in parts.items()} for method, parts in found.items()}


def article_statistics(document):
    """What the article alone asks, summed over points; a signature is its part's by its order."""
    orders = {}
    for key in ("findings", "below_limit", "not_shown"):
        orders.update((f["component"], f["order"]) for f in document.get(key, []) if f["component"] != "unknown")
    sums = dict.fromkeys(orders, 0.0)
    for point in document.get("points", []):
        for score in point["scores"]:
            if score["order"] is not None and sums:
                part = min(orders, key=lambda part: abs(orders[part] - score["order"]))
                sums[part] += score["article_statistic"]
    return sums
