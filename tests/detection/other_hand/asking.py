"""Asks rvbench about a specimen."""
import json
import subprocess
import tempfile
import time
from dataclasses import dataclass, replace
from pathlib import Path

from methods import article_statistics, plain_statistics
from specimen import index, kinematics_of, records_of, truth_of, write

ROOT = Path(__file__).resolve().parents[3]
KEPT = ("component", "mechanism", "severity", "limit", "confidence", "one_of", "may_follow_from", "p_value")


@dataclass
class Program:
    path: Path
    name: str = ""  # of its build
    sound: Path | None = None  # folder of sound units' answers
    with_methods: bool = False  # asks plain methods as well


def judged(specimen, folder, truth, program, *words):
    """What judge says of a specimen, and its truth."""
    began = time.monotonic()
    told = write(folder, truth, specimen)
    written = time.monotonic()
    command = [program.path, "judge", folder / "recording.h5", "--kinematics", kinematics_of(specimen, folder),
               "--json", *words]
    if program.sound:
        command += ["--sound", program.sound]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    try:
        document = json.loads(done.stdout)
    except json.JSONDecodeError:
        document = {"verdict": f"exit {done.returncode}", "findings": [], "quality": [done.stderr[-400:]]}
    return document, told, (round(written - began, 2), round(time.monotonic() - written, 2))


def hypotheses(document):
    """Each with where it stands: "findings", "below_limit", "not_shown"."""
    return [f | {"standing": key} for key in ("findings", "below_limit", "not_shown") for f in document.get(key, [])]


def just_visible(specimen, program, scratch):
    """The specimen with damage of so many times what its sound record said would just be seen.

    The index of a bad sun does not grow evenly with its severity, which is found in three steps."""
    (kind,), times = specimen.damages, specimen.changes["times_visible"]
    sound = replace(specimen, damages={}, changes={})
    document, _, _ = judged(sound, scratch / "sound", scratch / "sound_truth", program)
    part = truth_of(specimen)[0]
    visible = [f["smallest_visible"] for f in hypotheses(document) if f["component"] == part]
    if not visible or visible[0] is None:
        return None
    severity = 1.0
    for _ in range(3 if kind == "sun" else 1):
        _, records = records_of(replace(specimen, damages={kind: severity}, changes={}))
        severity *= times * visible[0] / index(records)
    return replace(specimen, damages={kind: severity})


def ask(specimen, program):
    """One line of the answers."""
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        asked = specimen
        if "times_visible" in specimen.changes:
            asked = just_visible(specimen, program, scratch)
        row = {"id": specimen.id, "part": specimen.part, "seed": specimen.seed, "sitting": specimen.sitting,
               "machine": specimen.machine, "planets": specimen.planets, "damages": specimen.damages,
               "changes": specimen.changes, "sound": program.sound is not None, "truth": truth_of(specimen),
               "program": program.name}
        if asked is None:
            return row | {"verdict": "cannot tell", "findings": []}
        document, told, spent_s = judged(asked, scratch / "given", scratch / "truth", program)
        if program.with_methods and specimen.machine == "rv20e":
            row["methods"] = plain_statistics(scratch / "given/recording.h5")
            row["methods"]["the article alone"] = article_statistics(document)
    return row | {
        "damages": asked.damages, "index": told["index"], "drawn": told["drawn"], "verdict": document["verdict"],
        "race_order": told["race_order"], "reason": document.get("reason", ""),
        "findings": [{key: f[key] for key in KEPT if key in f} for f in document.get("findings", [])],
        "parts": {f["component"]: [f["severity"], f["smallest_visible"], f["limit"], f["standing"]]
                  for f in hypotheses(document) if "smallest_visible" in f},
        "unknown": document.get("unknown", []),
        "notes": [q for q in document.get("quality", []) if not isinstance(q, dict) or q.get("invalidates")][:3],
        "written_s": spent_s[0], "judged_s": spent_s[1]}
