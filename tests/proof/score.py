#!/usr/bin/python3
"""score.py PROOF_FOLDER: opens the seals, and says what rvbench explain made of them.

PROOF_FOLDER holds, per case N: sealed/N.json, said/N.json (explain.json), said/N.run (seconds, exit
code and the SHA-256 of both) and said/N.baselines.json. Prints a line per case, and the card, with
what the baselines make of the same cases beside it.
"""
import hashlib
import json
import math
import pathlib
import statistics
import sys

from baselines_said import baselines_said

TARGETS = [  # quantity, key, target as text, whether a value meets it
    ("false alarms on nulls", "false_alarms", "0 (at most 5 %)", lambda v: v <= 0.05),
    ("self-null answered NULL", "self_null", ">= 95 %", lambda v: v >= 0.95),
    ("detection at 7 dB and above", "detection", ">= 90 %", lambda v: v >= 0.9),
    ("localisation, given detection", "localisation", ">= 90 %", lambda v: v >= 0.9),
    ("naming top-1 at 10 dB and above", "top1_10", ">= 90 %", lambda v: v >= 0.9),
    ("naming top-3 at 10 dB and above", "top3_10", ">= 97 %", lambda v: v >= 0.97),
    ("naming top-1 at 3 dB", "top1_3", ">= 70 %", lambda v: v >= 0.7),
    ("naming top-3 at 3 dB", "top3_3", ">= 90 %", lambda v: v >= 0.9),
    ("wrong name", "wrong", "<= 10 %", lambda v: v <= 0.1),
    ("two or three effects: exact set", "exact_set", ">= 65 %", lambda v: v >= 0.65),
    ("two or three effects: F1", "f1", ">= 0.85", lambda v: v >= 0.85),
    ("twins answered CLASS or NOT_RESOLVABLE", "twins", ">= 90 %", lambda v: v >= 0.9),
    ("out of library answered NONE_OF_THE_ABOVE", "outside", ">= 80 %", lambda v: v >= 0.8),
    ("out of library given a name", "outside_wrong", "<= 10 %", lambda v: v <= 0.1),
    ("median error of parameters", "parameter_error", "<= 10 %", lambda v: v <= 0.1),
    ("90 % intervals that hold the truth", "coverage", "83 to 96 %", lambda v: 0.83 <= v <= 0.96),
    ("held-out error that remains, median", "remaining", "<= 0.10", lambda v: v <= 0.1),
    ("held-out error over its floor, median", "over_floor", "<= 1.3", lambda v: v <= 1.3),
    ("named 30 dB below the strongest line", "named_30", "yes: >= half", lambda v: v >= 0.5),
    ("seconds per case, median", "seconds", "<= 45", lambda v: v <= 45),
]


NOT_OF_BASELINES = {"self_null", "localisation", "parameter_error", "coverage", "over_floor",
                    "seconds"}
REFUSED = "REFUSED"  # by its exit code, or it never came to an answer: right for no case


def wilson(hits, of, z=1.96):
    """Interval of a share. Source: Wilson, J. Am. Stat. Assoc. 22, 209-212 (1927)."""
    if of == 0:
        return 0.0, 1.0
    p = hits / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z / (1 + z * z / of) * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return max(0.0, middle - half), min(1.0, middle + half)


def names_of(effect):
    return [effect["name"], *[n for n in effect["class"] if n != effect["name"]]]


def accepted(truth):
    return {truth["name"], *truth["also"]}


def is_named(effect, truth):
    """By its name, or as one of a class that holds its name."""
    return bool(accepted(truth) & set(names_of(effect)))


def is_located(effect, truth, machine):
    """None where no answer could be wrong: what acts anywhere, or in the one body there is."""
    if truth["anywhere"] or machine in ("axis", "oscillator"):
        return None
    return all(body in effect["location"]["where"] for body in truth["bodies"])


def score_single(said, truth, row):
    effects = said["effects"]
    row["top1"] = row["top3"] = False
    if not effects:
        return
    first = effects[0]
    ranking = names_of(first) + [rival["name"] for rival in first["rivals"]]
    ranking = list(dict.fromkeys(ranking))
    row["top1"] = is_named(first, truth)
    row["top3"] = bool(accepted(truth) & set(ranking[:3])) or row["top1"]
    row["wrong"] = not row["top1"]
    row["located"] = is_located(first, truth, row["machine"])
    if not row["top1"] or first["name"] != truth["name"]:
        return
    for parameter in first["parameters"]:
        if truth["value"] and parameter["name"] == truth["parameter"]:
            low, high = parameter["ci90"]
            row["parameter_error"] = abs(parameter["value"] / truth["value"] - 1)
            row["covered"] = low <= truth["value"] <= high


def score_several(said, truths, row):
    effects = said["effects"]
    found = [any(is_named(e, t) for e in effects) for t in truths]
    meant = [any(is_named(e, t) for t in truths) for e in effects]
    precision = sum(meant) / len(meant) if meant else 0.0
    recall = sum(found) / len(found)
    row["exact"] = all(found) and all(meant) and len(effects) == len(truths)
    row["f1"] = 2 * precision * recall / (precision + recall) if precision + recall else 0.0
    row["wrong"] = not all(meant)


def score_case(sealed, said, run):
    verdict = said["verdict"]
    row = {key: sealed[key] for key in ("case", "kind", "machine", "variant")}
    row |= {"verdict": verdict, "seconds": run["seconds"], "wrong": False}
    row["truth"] = [t["name"] for t in sealed["effects"]]
    row["said"] = [names_of(e) for e in said["effects"]]
    row["self_null"] = (said.get("self_null") or {}).get("verdict")
    row["detected"] = bool(said["effects"]) or verdict == "NONE_OF_THE_ABOVE" or bool(
        (said.get("located") or {}).get("before"))
    if sealed["effects"]:
        row["snr_dB"] = sealed["effects"][0]["snr_dB"]
        row["concealment_dB"] = sealed["effects"][0].get("concealment_dB")
    kind = sealed["kind"]
    if kind == "null":
        row["false_alarm"] = bool(said["effects"]) or verdict in ("NONE_OF_THE_ABOVE", REFUSED)
        row["right"] = not row["false_alarm"]
    elif kind == "single":
        score_single(said, sealed["effects"][0], row)
        row["right"] = row["top1"]
    elif kind == "several":
        score_several(said, sealed["effects"], row)
        row["right"] = row["exact"]
    elif kind == "twin":
        is_class = any(
            e["verdict"] == "CLASS" and is_named(e, sealed["effects"][0]) for e in said["effects"])
        row["right"] = is_class or verdict == "NOT_RESOLVABLE"
    else:
        row["right"] = verdict == "NONE_OF_THE_ABOVE"
        row["wrong"] = bool(said["effects"])
    held_out = (said.get("fit") or {}).get("held_out") or {}
    before, after, floor = (held_out.get(k) for k in ("before", "after", "floor"))
    if kind in ("single", "several") and row["right"] and None not in (before, after, floor):
        row["over_floor"] = after / floor if floor else None
        row["remaining"] = max(0.0, after - floor) / (before - floor) if before > floor else None
    return row


def share(rows, key):
    values = [bool(r[key]) for r in rows if r.get(key) is not None]
    return (sum(values), len(values))


def median(rows, key):
    values = [r[key] for r in rows if r.get(key) is not None]
    return statistics.median(values) if values else None


def card_of(rows):
    of = lambda kind: [r for r in rows if r["kind"] == kind]
    singles = of("single")
    near = lambda low, high: [r for r in singles if low <= r["snr_dB"] < high]
    nulls, loud = of("null"), near(7, 999)
    shares = {
        "false_alarms": share(nulls, "false_alarm"),
        "self_null": (sum(r["self_null"] == "NULL" for r in rows if r["self_null"]),
                      sum(bool(r["self_null"]) for r in rows)),
        "detection": share(loud, "detected"),
        "localisation": share([r for r in loud if r["said"]], "located"),
        "top1_10": share(near(9.5, 999), "top1"),
        "top3_10": share(near(9.5, 999), "top3"),
        "top1_3": share(near(2.5, 7), "top1"),
        "top3_3": share(near(2.5, 7), "top3"),
        "wrong": share(singles, "wrong"),
        "exact_set": share(of("several"), "exact"),
        "twins": share(of("twin"), "right"),
        "outside": share(of("outside"), "right"),
        "outside_wrong": share(of("outside"), "wrong"),
        "coverage": share(singles, "covered"),
        "named_30": share([r for r in singles if (r["concealment_dB"] or 0) > 29], "top1"),
    }
    several = of("several")
    values = {
        "f1": statistics.mean(r["f1"] for r in several) if several else None,
        "parameter_error": median(singles, "parameter_error"),
        "remaining": median(rows, "remaining"),
        "over_floor": median(rows, "over_floor"),
        "seconds": median(rows, "seconds"),
    }
    return shares, values


def in_short(shares, values, key):
    if key in values:
        return "-" if values[key] is None else f"{values[key]:.3g}"
    hits, of = shares[key]
    return f"{100 * hits / of:.0f} %" if of else "-"


def card_lines(rows, baselines):
    """Per quantity: its name, the figure, the target, whether it is met, the baselines' figures."""
    shares, values = card_of(rows)
    others = [card_of(of) for of in baselines.values()]
    for quantity, key, target, meets in TARGETS:
        of_others = ["-" if key in NOT_OF_BASELINES else in_short(*card, key) for card in others]
        if key in shares:
            hits, of = shares[key]
            if not of:
                continue
            low, high = wilson(hits, of)
            yield (quantity, f"{hits}/{of} = {100 * hits / of:.0f} % ({100 * low:.0f} to "
                   f"{100 * high:.0f})", target, meets(hits / of), of_others)
        elif values[key] is not None:
            yield quantity, f"{values[key]:.3g}", target, meets(values[key]), of_others


def read_cases(folder):
    """Per case that was run, in order: what was sealed, what was said, how it ran. The hashes are
    those that were printed, or nothing is scored."""
    cases = []
    for path in sorted(folder.glob("sealed/*.json"), key=lambda p: int(p.stem)):
        answer = folder / "said" / path.name
        run = folder / "said" / f"{path.stem}.run"
        if not run.exists():
            continue
        run = json.loads(run.read_text())
        if run["sealed_sha256"] != hashlib.sha256(path.read_bytes()).hexdigest():
            sys.exit(f"score: {path} is not what was sealed")
        said = {"verdict": REFUSED, "effects": []}
        if answer.exists():
            if run["said_sha256"] != hashlib.sha256(answer.read_bytes()).hexdigest():
                sys.exit(f"score: {answer} is not what was said")
            said = json.loads(answer.read_text())
        cases.append((json.loads(path.read_text()), said, run))
    return cases


def main(folder):
    cases = read_cases(folder)
    rows = [score_case(*case) for case in cases]
    sealed = [case[0] for case in cases]
    baselines = {
        method: [score_case(*case) for case in of_method]
        for method, of_method in baselines_said(folder / "said", sealed).items()
    }
    for row in rows:
        mark = "" if row["right"] else "  <- not right"
        said = " + ".join("|".join(names) for names in row["said"]) or "-"
        snr = f" {row['snr_dB']:.0f} dB" if "snr_dB" in row else ""
        print(f"{row['case']:4} {row['kind']:8} {row['machine']:10}"
              f"{'+'.join(row['truth']) or '-'}{snr}: {row['verdict']} {said}"
              f" ({row['seconds']:.0f} s){mark}")
    print()
    print(f"{'':44} {'rvbench explain':30} {'target':18} {'':8}" +
          "".join(f"{method:>20}" for method in baselines))
    for quantity, value, target, met, others in card_lines(rows, baselines):
        print(f"{quantity:44} {value:30} {target:18} {'' if met else 'NOT MET':8}" +
              "".join(f"{other:>20}" for other in others))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
