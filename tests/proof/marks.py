"""How a case is marked: what was sealed, beside what was said."""
import hashlib
import json
import math
import sys

REFUSED = "REFUSED"  # by its exit code, or it never came to an answer: right for no case


def names_of(effect):
    return [effect["name"], *[n for n in effect["class"] if n != effect["name"]]]


def accepted(truth):
    return {truth["name"], *truth["also"]}


def claims(said):
    """The effects that are said to be left out. A plant that is called miscalibrated, or wrong in
    something that no name fits, has none."""
    return said["effects"] if said["verdict"] in ("NAMED", "CLASS") else []


def is_named(effect, truth):
    """By its name, or by another that these records cannot part from it."""
    return effect["name"] in accepted(truth)


def places_of(effect):
    """Per place where it may act: the bodies that are told, without what they are told by."""
    return [set(place.split(", by ")[0].replace(" against ", " and ").replace(", ", " and ")
                .removesuffix(" alike").split(" and "))
            for place in effect["location"]["where"].split(" or ")]


def is_located(effects, truth, machine):
    """None where no answer could be wrong: what acts anywhere, or in the one body there is. Two
    places at the most: bodies that mirror each other."""
    if truth["anywhere"] or not truth["bodies"] or machine in ("axis", "oscillator"):
        return None
    if not effects or not is_named(effects[0], truth):
        return False
    places = places_of(effects[0])
    return len(places) <= 2 and any(set(truth["bodies"]) <= place for place in places)


def mark_estimate(effect, truth, row):
    """Its size beside the true one, where the two are the same quantity: of what may act anywhere
    the same lines need another size at each place."""
    is_comparable = (truth["parameter"] and truth["value"] and not truth["anywhere"]
                     and effect["name"] == truth["name"])
    if not is_comparable or not effect["parameters"]:  # baselines have none
        return
    parameters = {p["name"]: p for p in effect["parameters"]}
    if truth["parameter"] not in parameters:
        sys.exit(f"score: case {row['case']}: {effect['name']} has no {truth['parameter']}")
    own = parameters[truth["parameter"]]
    low, high = own["ci90"] or (math.nan, math.nan)
    row["estimate"] = [v / truth["value"] for v in (own["value"], low, high)]
    row["parameter_error"] = abs(row["estimate"][0] - 1)
    row["covered"] = low <= truth["value"] <= high


def mark_single(said, truth, row):
    effects = claims(said)
    row["located"] = is_located(effects, truth, row["machine"])
    ranking = [n for e in effects[:1] for n in names_of(e) + [r["name"] for r in e["rivals"]]]
    ranking = list(dict.fromkeys(ranking))
    row["top1"] = bool(effects) and is_named(effects[0], truth)
    row["own_name"] = row["top1"] and effects[0]["name"] == truth["name"]
    row["top3"] = row["top1"] or bool(accepted(truth) & set(ranking[:3]))
    row["wrong"] = any(not accepted(truth) & set(names_of(e)) for e in effects)
    row["wrong_beside"] = not effects and any(not accepted(truth) & set(names_of(e))
                                              for e in said["effects"])
    if row["top1"]:
        mark_estimate(effects[0], truth, row)


def matched(effects, truths):
    """How many can be paired, each with one of its own."""
    if not effects or not truths:
        return 0
    first, *others = effects
    best = matched(others, truths)
    for i, truth in enumerate(truths):
        if is_named(first, truth):
            best = max(best, 1 + matched(others, truths[:i] + truths[i + 1:]))
    return best


def mark_several(said, truths, row):
    # One effect may be told in two lines: once and twice a turn.
    effects = list({e["name"]: e for e in claims(said)}.values())
    right = matched(effects, truths)
    row["exact"] = right == len(truths) == len(effects)
    row["f1"] = 2 * right / (len(truths) + len(effects))
    row["wrong"] = right < len(effects)


def mark_null(verdict, said, row):
    """A machine that its plant describes but for nuisances may be called miscalibrated by these."""
    row["false_alarm"] = bool(said["effects"]) or verdict not in (
        "NULL", "MISCALIBRATED", "NOT_RESOLVABLE")
    row["right"] = verdict == "NULL" or (verdict == "MISCALIBRATED" and row["variant"] != "clean")


def is_class_of(said, truth):
    """One class, of nothing but twins, the hidden one among them."""
    effects = said["effects"]
    return (len(effects) == 1 and effects[0]["verdict"] == "CLASS"
            and truth["name"] in effects[0]["class"] and len(effects[0]["class"]) > 1
            and set(effects[0]["class"]) <= accepted(truth))


def mark_real(said, truths, row):
    """What a publication names must come first; what comes after it is not known to be wrong."""
    effects = claims(said)
    row["right"] = bool(effects) and is_named(effects[0], truths[0])


def mark_fit(said, row):
    """What remains of the held-out error, above what noise leaves there."""
    held_out = (said.get("fit") or {}).get("held_out") or {}
    out = {"condition": held_out, "speed": held_out.get("speeds"), "load": held_out.get("loads")}
    for left_out, error in out.items():
        before, after, floor = ((error or {}).get(k) for k in ("before", "after", "floor"))
        if None in (before, after, floor) or before <= floor:
            continue
        row[f"remaining_{left_out}"] = max(0.0, after - floor) / (before - floor)
    if held_out.get("after") and held_out.get("floor"):
        row["over_floor"] = held_out["after"] / held_out["floor"]


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
        mark_null(verdict, said, row)
    elif kind == "single":
        mark_single(said, sealed["effects"][0], row)
        row["right"] = row["top1"] and not row["wrong"]
    elif kind == "several":
        mark_several(said, sealed["effects"], row)
        row["right"] = row["exact"]
    elif kind == "twin":
        row["right"] = verdict == "NOT_RESOLVABLE" or is_class_of(said, sealed["effects"][0])
    else:
        row["wrong"] = bool(said["effects"])
        row["right"] = verdict == "NONE_OF_THE_ABOVE" and not row["wrong"]
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
