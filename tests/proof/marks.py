"""How a case is marked: what was sealed, beside what was said."""
import hashlib
import json
import sys

REFUSED = "REFUSED"  # by its exit code, or it never came to an answer: right for no case


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


def mark_single(said, truth, row):
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
            row["estimate"] = [v / truth["value"] for v in (parameter["value"], low, high)]
            row["parameter_error"] = abs(row["estimate"][0] - 1)
            row["covered"] = low <= truth["value"] <= high


def mark_several(said, truths, row):
    effects = said["effects"]
    found = [any(is_named(e, t) for e in effects) for t in truths]
    meant = [any(is_named(e, t) for t in truths) for e in effects]
    precision = sum(meant) / len(meant) if meant else 0.0
    recall = sum(found) / len(found)
    # One effect may be told in two lines: once and twice a turn.
    told = {e["name"] for e in effects}
    row["exact"] = all(found) and all(meant) and len(told) == len(truths)
    row["f1"] = 2 * precision * recall / (precision + recall) if precision + recall else 0.0
    row["wrong"] = not all(meant)


def mark_real(said, truths, row):
    """What a publication names must come first; what comes after it is not known to be wrong."""
    effects = said["effects"]
    row["right"] = bool(effects) and is_named(effects[0], truths[0])
    held_out = (said.get("fit") or {}).get("held_out") or {}
    row["held_out"] = (held_out.get("before"), held_out.get("after"))


def mark_fit(said, row):
    """What remains of the held-out error, above what noise leaves."""
    held_out = (said.get("fit") or {}).get("held_out") or {}
    floor = held_out.get("floor")
    out = {"condition": held_out, "speed": held_out.get("speeds"), "load": held_out.get("loads")}
    for left_out, error in out.items():
        before, after = ((error or {}).get(k) for k in ("before", "after"))
        if None in (before, after, floor) or before <= floor:
            continue
        row[f"remaining_{left_out}"] = max(0.0, after - floor) / (before - floor)
    if held_out.get("after") and floor:
        row["over_floor"] = held_out["after"] / floor


def mark_case(sealed, said, run):
    verdict = said["verdict"]
    row = {key: sealed[key] for key in ("case", "kind", "machine", "variant")}
    row |= {"verdict": verdict, "seconds": run["seconds"], "wrong": False}
    row["truth"] = [t["name"] for t in sealed["effects"]]
    row["said"] = [names_of(e) for e in said["effects"]]
    row["self_null"] = (said.get("self_null") or {}).get("verdict")
    row["detected"] = bool(said["effects"]) or verdict == "NONE_OF_THE_ABOVE" or bool(
        (said.get("located") or {}).get("before"))
    if sealed["effects"]:
        row["snr_dB"] = sealed["effects"][0].get("snr_dB")
        row["concealment_dB"] = sealed["effects"][0].get("concealment_dB")
    kind = sealed["kind"]
    if kind == "real":
        mark_real(said, sealed["effects"], row)
        return row
    if kind == "null":
        row["false_alarm"] = bool(said["effects"]) or verdict in ("NONE_OF_THE_ABOVE", REFUSED)
        row["right"] = not row["false_alarm"]
    elif kind == "single":
        mark_single(said, sealed["effects"][0], row)
        row["right"] = row["top1"]
    elif kind == "several":
        mark_several(said, sealed["effects"], row)
        row["right"] = row["exact"]
    elif kind == "twin":
        is_class = any(
            e["verdict"] == "CLASS" and is_named(e, sealed["effects"][0]) for e in said["effects"])
        row["right"] = is_class or verdict == "NOT_RESOLVABLE"
    else:
        row["right"] = verdict == "NONE_OF_THE_ABOVE"
        row["wrong"] = bool(said["effects"])
    if kind in ("single", "several") and row["right"]:
        mark_fit(said, row)
    return row


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
