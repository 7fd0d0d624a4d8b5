"""One specimen: its unit, its records, and what is done to them on their way into a file."""
import functools
import json
from pathlib import Path

import numpy as np

from draws import TURN, Draws
from machines import PlanetaryStage, RvReducer, TwoStageTrain
from recording import write_recording
from unit import RATE_HZ, Unit

OTHER_RV = ((15, 30, 40), (10, 32, 40), (12, 42, 40), (16, 40, 36), (14, 35, 44))


def other_rv(draws, planets):
    teeth = OTHER_RV[draws.whole("tooth counts", 0, len(OTHER_RV) - 1)]
    balls, ratio = draws.whole("balls", 8, 14), draws.uniform("ball over pitch diameter", 0.14, 0.25)
    bearing = {"rolling_elements": balls, "ball_diameter_mm": 26 * ratio, "pitch_diameter_mm": 26,
               "assumption": "drawn"}
    kinematics = {"machine": "RV reducer", "source": "drawn", "rv_reducer": {
        "sun_teeth": teeth[0], "planet_teeth": teeth[1], "planets": planets, "lobes": teeth[2] - 1, "pins": teeth[2],
        "rated_output_torque_Nm": 167, "crank_bearing": bearing}}
    return RvReducer(draws, planets, teeth, (balls, ratio), kinematics)


def other_bearing(draws, planets):
    """An RV-20E whose crank bearing is not the one that the file assumes."""
    balls = draws.whole("balls", 8, 10) + 5 * draws.whole("more balls", 0, 1)
    return RvReducer(draws, planets, race=(balls, draws.uniform("ball over pitch diameter", 0.12, 0.3)))


def machine_of(name, planets):
    machines = {"rv20e": functools.partial(RvReducer, planets=planets), "two_stage": TwoStageTrain,
                "planetary": PlanetaryStage, "other_rv": functools.partial(other_rv, planets=planets),
                "other_bearing": functools.partial(other_bearing, planets=planets)}
    return machines[name]


def changed(record, unit, changes, point):
    """What the sensors hear after hum, tones, noise or a bad channel."""
    heard = record.heard()
    stream = Draws(*unit.draws.seed, 77).stream(f"changes at {point}")
    clean = record.mesh + record.rest + record.damage
    level = float(np.sqrt(np.mean(clean**2)))
    seconds = np.arange(heard.shape[1]) / RATE_HZ
    if "hum" in changes:
        for scale, frequency_Hz in ((1, 100), (0.2, 200)):
            heard += np.sqrt(2) * changes["hum"] * scale * level * np.cos(TURN * frequency_Hz * seconds)
    if "tone" in changes:
        turns = record.turns[::2][: heard.shape[1]]
        heard += np.sqrt(2) * changes["tone"] * level * np.cos(TURN * 2.03 * turns)
    if "white" in changes:
        heard += changes["white"] * level * stream.standard_normal(heard.shape)
    channel = int(Draws(*unit.draws.seed, 78).stream("channel").integers(len(heard)))
    if "dead_channel" in changes:
        heard[channel] = 0
    if "channels" in changes:
        heard = heard[: changes["channels"]]
    if "clipped_channel" in changes:
        peak = 0.3 * np.max(np.abs(heard[channel]))
        heard[channel] = np.clip(heard[channel], -peak, peak)
    return heard


def records_of(specimen):
    """Its unit, and a record of each point."""
    unit = Unit(machine_of(specimen.machine, specimen.planets), specimen.seed, specimen.sitting)
    unit.angle_noise_rad = specimen.changes.get("angle_noise_rad", unit.angle_noise_rad)
    return unit, [unit.record(point, rpm, load, specimen.damages, specimen.changes.get("noise_scale", 1.0))
                  for point, (rpm, load) in enumerate(specimen.points)]


def write(folder, truth, specimen):
    """Writes the specimen's recording into one folder, its truth into another, and returns the truth."""
    unit, records = records_of(specimen)
    changes, damages = specimen.changes, specimen.damages
    folder.mkdir(parents=True, exist_ok=True)
    truth.mkdir(parents=True, exist_ok=True)
    write_recording(folder / "recording.h5", unit, records,
                    [changed(record, unit, changes, n) for n, record in enumerate(records)])
    if isinstance(unit.machine.kinematics, dict):
        (folder / "kinematics.json").write_text(json.dumps(unit.machine.kinematics, indent=1) + "\n")
    told = {"parts": truth_of(specimen), "damages": damages, "changes": changes,
            "index": {kind: index(records) for kind in damages}, "drawn": unit.draws.drawn,
            "race_order": unit.machine.race.blows * unit.machine.race_turns}
    (truth / "truth.json").write_text(json.dumps(told, indent=1) + "\n")
    return told


SHIPPED = Path(__file__).resolve().parents[3] / "bench/kinematics/rv20e.json"
CLASSES = {"two_stage": TwoStageTrain, "planetary": PlanetaryStage}


def truth_of(specimen):
    """The damaged parts, as rvbench names them."""
    return [CLASSES.get(specimen.machine, RvReducer).parts[kind] for kind in specimen.damages]


def kinematics_of(specimen, folder):
    """The file that a recording is to be judged by; an RV-20E's is the one that ships, with its planets."""
    own = folder / "kinematics.json"
    if not own.exists():
        shipped = json.loads(SHIPPED.read_text())
        shipped["rv_reducer"]["planets"] = specimen.planets
        own.write_text(json.dumps(shipped))
    return own


def index(records):
    """Amplitude of the damage's part over the rms of the mesh's, median over channels and points."""
    ratios = [np.sqrt(2 * np.mean(r.damage**2, axis=1) / np.mean(r.mesh**2, axis=1)) for r in records]
    return float(np.median(np.concatenate(ratios)))
