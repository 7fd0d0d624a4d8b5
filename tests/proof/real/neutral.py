"""Recordings of real machines in other words.

A motion x, a force F and the time t become k_x·x, k_F·F and t/k_t, with factors drawn from a seed:
an inertia becomes k_F/(k_x·k_t²) of it, damping k_F/(k_x·k_t), stiffness k_F/k_x. What slid turns.
"""
import json
import random

import numpy as np
from scipy.io import loadmat

WITHIN = 5  # factors between a fifth and five times


class Measures:
    def __init__(self, seed, keeps_way=False):
        draw = random.Random(seed)
        way, self.force, self.time = (WITHIN ** draw.uniform(-1, 1) for _ in range(3))
        self.way = 1.0 if keeps_way else way

    def inertia(self, value):
        return value * self.force / (self.way * self.time**2)

    def damping(self, value):
        return value * self.force / (self.way * self.time)

    def stiffness(self, value):
        return value * self.force / self.way


def quantity(value, unit, tolerance_pct="free"):
    return {"value": value, "unit": unit, "tolerance_pct": tolerance_pct}


def term(kind, **parameters):
    return {"type": kind, "body_a": "body", "parameters": parameters}


def plant(inertia, terms, inputs, outputs):
    return {"plant": "machine", "about": "a machine",
            "bodies": [{"name": "body", "motion": "rotation", "inertia": inertia}],
            "terms": terms, "inputs": inputs, "outputs": outputs}


def write_columns(folder, columns):
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / "recording.csv"
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", comments="",
               header=",".join(columns), fmt="%.10g")
    return path.name


def shipped(plants, name):
    """The numbers of a shipped plant: its inertia, and of each term by its type."""
    read = json.loads((plants / f"{name}.json").read_text())
    body = read["bodies"][0]
    return (body.get("mass") or body["inertia"])["value"], {
        t["type"]: {n: q["value"] for n, q in t["parameters"].items()} for t in read["terms"]}


def neutral_silverbox(data, plants, seed, folder):
    k = Measures(seed)
    mass, of = shipped(plants, "silverbox")
    table = np.genfromtxt(data / "silverbox/SNLS80mV.csv", delimiter=",", skip_header=1)
    file = write_columns(folder, {"a": k.force * table[:, 0], "b": k.way * table[:, 1]})
    campaign = json.loads((plants / "../../tests/campaigns/silverbox.json").read_text())
    records = [r | {"from_s": r["from_s"] / k.time, "to_s": r["to_s"] / k.time,
                    "condition": f"c{i + 1}"}
               for i, r in enumerate(campaign["files"][0]["records"])]
    rate_Hz = campaign["files"][0]["rate_Hz"] * k.time
    spring = k.stiffness(of["spring"]["stiffness"])
    damper = k.damping(of["damper"]["damping"])
    return plant(
        quantity(k.inertia(mass), "kg·m²"),
        [term("spring", stiffness=quantity(spring, "N·m/rad")),
         term("damper", damping=quantity(damper, "N·m·s/rad"))],
        [{"channel": "a", "unit": "N·m", "is": "force", "body": "body",
          "offset": quantity(0, "N·m"), "between_samples": "band_limited"}],
        [{"channel": "b", "unit": "rad", "is": "position", "body": "body",
          "offset": quantity(0, "rad"), "delay": quantity(0, "s")}],
    ), {"campaign": "c", "files": [{"file": file, "rate_Hz": rate_Hz, "records": records}]}


def neutral_emps(data, plants, seed, folder):
    k = Measures(seed)
    mass, of = shipped(plants, "emps")
    recorded = loadmat(data / "emps/DATA_EMPS.mat")
    newton_per_volt = float(recorded["gtau"].squeeze())
    file = write_columns(folder, {
        "a": k.way * recorded["qm"].squeeze(),
        "b": k.force * newton_per_volt * recorded["vir"].squeeze()})
    campaign = json.loads((plants / "../../tests/campaigns/emps.json").read_text())
    records = [{"from_s": r["from_s"] / k.time, "to_s": r["to_s"] / k.time,
                "condition": f"c{i + 1}", "programme": "p"}
               for i, r in enumerate(campaign["files"][0]["records"])]
    return plant(
        quantity(k.inertia(mass), "kg·m²", 10),
        [term("viscous_friction",
              damping=quantity(k.damping(of["viscous_friction"]["damping"]), "N·m·s/rad")),
         term("torque_offset",
              level=quantity(k.force * of["torque_offset"]["level"], "N·m"))],
        [{"channel": "a", "unit": "rad", "is": "position", "body": "body",
          "band_Hz": 40 * k.time}],
        [{"channel": "b", "unit": "N·m", "is": "drive", "body": "body",
          "delay": quantity(0, "s")}],
    ), {"campaign": "c", "files": [{"file": file, "rate_Hz": 1000 * k.time, "records": records}]}


def neutral_ur10e(data, plants, seed, folder):
    """Angles stay: a weight pulls with the sine of one."""
    k = Measures(seed, keeps_way=True)
    inertia, of = shipped(plants, "ur10e_joint")
    read = json.loads((plants / "ur10e_joint.json").read_text())
    ampere_per_Nm = read["outputs"][0]["gain"]["value"]
    table = np.genfromtxt(data / "ur10e/ur-20_01_22-joint_1.csv", delimiter=",")
    start_s = table[0, 0]
    file = write_columns(folder, {
        "t": (table[:, 0] - start_s) / k.time, "a": table[:, 1], "b": k.time * table[:, 7],
        "c": k.force / ampere_per_Nm * table[:, 13]})
    return plant(
        quantity(k.inertia(inertia), "kg·m²"),
        [term("viscous_friction",
              damping=quantity(k.damping(of["viscous_friction"]["damping"]), "N·m·s/rad")),
         term("gravity", sine=quantity(0, "N·m"), cosine=quantity(0, "N·m"))],
        [{"channel": "a", "unit": "rad", "is": "position", "body": "body",
          "band_Hz": 10 * k.time},
         {"channel": "b", "unit": "rad/s", "is": "speed", "body": "body",
          "band_Hz": 10 * k.time}],
        [{"channel": "c", "unit": "N·m", "is": "drive", "body": "body",
          "offset": quantity(0, "N·m")}],
    ), {"campaign": "c", "files": [{"file": file, "rate_Hz": 100 * k.time, "time_column": "t"}]}
