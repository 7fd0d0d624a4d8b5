"""What the baselines said of cases, in the form of rvbench explain's answer."""
import json

from sklearn.neighbors import KNeighborsClassifier

METHODS = ("sindy", "frols", "gaussian_process")
NEAREST = "nearest_fingerprint"
CLEARLY_LESS = 0.98  # of the error: what has no names says so much that something is missing
NOTHING = ""  # the label of a machine that lacks nothing
OUTSIDE = "?"  # of one that lacks what has no name


def as_answer(names, remaining=None):
    """names  the likeliest first; None of a method that finds, and names nothing"""
    found_nothing = remaining is None or remaining > CLEARLY_LESS
    if names is None:
        return {"verdict": "NULL" if found_nothing else "NONE_OF_THE_ABOVE", "effects": []}
    effects = [{"name": name, "verdict": "NAMED", "class": [], "rivals": [], "parameters": [],
                "location": {"where": ""}} for name in names]
    if effects:
        effects[0]["rivals"] = [{"name": name} for name in names[1:]]
    held_out = {} if remaining is None else {"before": 1.0, "after": remaining, "floor": 0.0}
    return {"verdict": "NAMED" if names else "NULL", "effects": effects,
            "fit": {"held_out": held_out}}


def label_of(sealed):
    if sealed["kind"] == "outside":
        return OUTSIDE
    return sealed["effects"][0]["name"] if sealed["effects"] else NOTHING


def nearest(sealed, fingerprints):
    """Each case by the three nearest others of its machine, whose answers it is told."""
    answers = []
    for own, own_print in zip(sealed, fingerprints):
        others = [(label_of(s), [f.get(name, 0.0) for name in own_print])
                  for s, f in zip(sealed, fingerprints)
                  if s["case"] != own["case"] and s["machine"] == own["machine"] and f]
        if len(others) < 3 or not own_print:
            answers.append(as_answer([]))
            continue
        told = KNeighborsClassifier(3, weights="distance")
        told.fit([f for _, f in others], [label for label, _ in others])
        label = told.predict([list(own_print.values())])[0]
        is_name = label not in (NOTHING, OUTSIDE)
        answer = as_answer([label] if is_name else [])
        answers.append(answer | ({"verdict": "NONE_OF_THE_ABOVE"} if label == OUTSIDE else {}))
    return answers


def baselines_said(folders, cases):
    """Per method: (sealed, said, run) of each case that the baselines were shown."""
    shown = []
    for sealed, _, _ in cases:
        answers = [folder / "said" / f"{sealed['case']}.baselines.json" for folder in folders]
        shown += [(sealed, json.loads(a.read_text())) for a in answers if a.exists()][:1]
    no_time = {"seconds": 0}
    all_said = {}
    for method in METHODS:
        all_said[method] = [(s, as_answer(b[method]["names"], b[method]["remaining"]), no_time)
                            for s, b in shown]
    cases = [s for s, _ in shown]
    by_nearest = nearest(cases, [b["fingerprint"] for _, b in shown])
    all_said[NEAREST] = [(s, said, no_time) for s, said in zip(cases, by_nearest)]
    return all_said
