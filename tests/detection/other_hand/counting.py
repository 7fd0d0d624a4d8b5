"""What answers amount to."""
from collections import defaultdict
from itertools import permutations

import numpy as np

from parts import FIRST_LINE

COLUMNS = ("clean", "false alarm", "right", "wrong", "false PASS", "INVALID", "other")
FALSE_ALARMS = 0.03  # that a method may give on the tuning seeds
SURE = 0.9  # confidence
OF_A_RACE = 0.01  # relative: how far the spacing of an unknown family may be off the race's


def key_of(one):
    """Two specimens, or their answers, of one key are the same recording."""
    of = one if isinstance(one, dict) else vars(one)
    return of["part"], of["seed"], of["sitting"]


def kind_of(row):
    return "+".join(row["damages"]) or "healthy"


def names(finding):
    return finding.get("one_of") or [finding["component"]]


def is_true(finding, row):
    return bool(set(names(finding)) & set(row["truth"]))


def named(row):
    """Findings of known parts, but for one that may follow from the first."""
    follow = [f for f in row["findings"] if f.get("may_follow_from")]
    excused = [f for f in follow if f["may_follow_from"].startswith(row["findings"][0]["component"] + ":")]
    excused = excused if len(follow) == 1 else []
    return [f for f in row["findings"] if f not in excused and names(f) != ["unknown"]]


def is_excused(row):
    """A sound part is named, and may follow from the first finding."""
    return any(not is_true(f, row) and f not in named(row) and names(f) != ["unknown"] for f in row["findings"])


def answer(row):
    """One of COLUMNS."""
    if not row["truth"] and (row["verdict"] == "FAIL" or named(row)):
        return "false alarm"
    if not row["truth"] and row["verdict"] == "PASS":
        return "clean"
    if any(not is_true(f, row) for f in named(row)):
        return "wrong"
    if row["verdict"] == "PASS":
        return "false PASS"
    if row["verdict"] == "FAIL" and row["findings"] and is_true(row["findings"][0], row):
        return "right"
    return "INVALID" if row["verdict"] == "INVALID" else "other"


def grouped(rows, key):
    groups = defaultdict(list)
    for row in rows:
        groups[key(row)].append(row)
    return groups


def heading(heads):
    print(heads + f"{'units':>6}" + "".join(f"{column:>12}" for column in COLUMNS))


def line(heads, answers):
    print(heads + f"{len(answers):6}" + "".join(f"{answers.count(column):12}" for column in COLUMNS))


def part_of(row):
    return row["part"] + (" --sound" if row["sound"] else "")


def table(rows):
    heading(f"{'part':30}{'kind':22}")
    for (part, kind), members in grouped(rows, lambda row: (part_of(row), kind_of(row))).items():
        line(f"{part:30}{kind:22}", [answer(row) for row in members])


def sums(rows):
    """All kinds of damage together, and how the right ones were named."""
    heading(f"{'part':30}{'':12}")
    for part, members in grouped(rows, part_of).items():
        for what, of in (("healthy", [r for r in members if not r["truth"]]),
                         ("faulty", [r for r in members if r["truth"]])):
            if of:
                line(f"{part:30}{what:12}", [answer(row) for row in of])
        right = [row for row in members if answer(row) == "right"]
        sets = sum(len(names(row["findings"][0])) > 1 for row in right)
        if right:
            print(f"{'':30}sets among the right ones: {sets}; a second finding that may follow from the first: "
                  f"{sum(map(is_excused, members))}")


def confusion(rows):
    """Kind of damage by the part that was named first."""
    first = {id(row): "/".join(names(row["findings"][0])) if row["findings"] else row["verdict"] for row in rows}
    columns = sorted(set(first.values()))
    print(f"{'kind':12}" + "".join(f"{column[:18]:>20}" for column in columns))
    for kind, members in grouped(rows, kind_of).items():
        print(f"{kind:12}" + "".join(f"{sum(first[id(r)] == column for r in members):20}" for column in columns))


def reliability(rows):
    """Of findings with some confidence, how many are right, by tenths."""
    print(f"{'confidence':>12}{'findings':>10}{'right':>8}")
    tenths = defaultdict(list)
    for row in rows:
        for finding in row["findings"]:
            if finding.get("confidence") is not None:
                tenths[min(9, int(10 * finding["confidence"]))].append(is_true(finding, row))
    for tenth in sorted(tenths):
        right = tenths[tenth]
        print(f"{tenth / 10:8.1f} to {(tenth + 1) / 10:.1f}{len(right):9}{sum(right) / len(right):8.0%}")


def found_at(rows):
    """Smallest severity at which 90 % are right, between those that were asked."""
    for kind, members in grouped([r for r in rows if len(r["damages"]) == 1], kind_of).items():
        shares = {}
        for severity, same in grouped(members, lambda r: round(next(iter(r["damages"].values())), 3)).items():
            shares[severity] = np.mean([answer(row) == "right" for row in same])
        severities = sorted(shares)
        enough = [s for s in severities if shares[s] >= 0.9]
        told = " ".join(f"{s:g}: {shares[s]:.0%}" for s in severities[:8])
        print(f"{kind:12} {min(enough) if enough else 'none':>6}  ({told})")


def is_same_answer(one, other):
    """The same verdict, and the same part named first."""
    def first(row):
        return names(row["findings"][0]) if row["findings"] else []
    return one["verdict"] == other["verdict"] and first(one) == first(other)


def pairs_of(rows):
    """Answers to units that were judged twice."""
    twice = [row for row in rows if row["part"] == "remounted" and not row["sound"]]
    of_unit = grouped(twice, lambda row: row["seed"])
    return [pair for pair in of_unit.values() if len(pair) == 2]


def plain_of(rows):
    """{seed: answer} to the units of the first line as they are."""
    return {row["seed"]: row for row in rows if row["part"] in FIRST_LINE and not row["sound"]}


def parts_found(row):
    """How many bad parts are named, each by a finding of its own."""
    nobody = [set()] * len(row["truth"])
    findings = [set(names(f)) for f in row["findings"]] + nobody
    return max(sum(part in of for part, of in zip(row["truth"], order))
               for order in permutations(findings, len(row["truth"])))


def has_race_spacing(row):
    """An unknown family is spaced as the bad race's blows are."""
    return any(family["kind"] == "bearing-like" and abs(family["spacing"] / row["race_order"] - 1) < OF_A_RACE
               for family in row["unknown"])


def is_shown(row):
    return any(row.get("parts", {}).get(part, ["not_shown"])[-1] != "not_shown" for part in row["truth"])


def seen(rows):
    """Of damage that was made as large as what a sound record said would be seen, how much was shown."""
    for (part, kind), members in grouped(rows, lambda row: (row["part"], kind_of(row))).items():
        print(f"{part}, {kind}: {len(members)} units; shown: {sum(map(is_shown, members))}")


def usual(rows):
    """{method: {part: (median, limit)}}, so that at most 3 % of sound units have a part above its limit."""
    found = {}
    for method in rows[0]["methods"]:
        parts = sorted(rows[0]["methods"][method])
        values = np.array([[row["methods"][method].get(part, 0.0) for part in parts] for row in rows])
        for limits in np.sort(values, axis=0):  # from the lowest upwards
            if np.mean((values > limits).any(axis=1)) <= FALSE_ALARMS:
                break
        found[method] = dict(zip(parts, zip(np.median(values, axis=0), limits)))
    return found


def answer_of_method(row, method, limits):
    """Names the part that is farthest above its limit."""
    above = {part: (row["methods"][method].get(part, 0.0) - median) / max(limit - median, 1e-12)
             for part, (median, limit) in limits.items()}
    first = max(above, key=above.get)
    if above[first] <= 1:
        return "false PASS" if row["truth"] else "clean"
    if not row["truth"]:
        return "false alarm"
    return "right" if first in row["truth"] else "wrong"


def beside(rows, tuned, before):
    """rvbench, the methods and the program as it was before, on the same units, by their number of planets."""
    tuned = [row for row in tuned if "methods" in row and not row["truth"]]
    of_before = {key_of(row): row for row in before}
    asked = [row for row in rows if "methods" in row and not row["sound"]]
    asked = [row for row in asked if not before or key_of(row) in of_before]
    for planets, members in grouped(asked, lambda row: row["planets"]).items():
        answers = {"rvbench": [answer(row) for row in members]}
        for method, limits in usual([row for row in tuned if row["planets"] == planets]).items():
            answers[method] = [answer_of_method(row, method, limits) for row in members]
        if before:
            answers["rvbench before"] = [answer(of_before[key_of(row)]) for row in members]
        print()
        heading(f"{f'method, {planets} planets':44}")
        for method, of in answers.items():
            line(f"{method:44}", of)


def quartiles(rows):
    drawn = defaultdict(list)
    for row in rows:
        for name, value in row.get("drawn", {}).items():
            drawn[name].append(value)
    for name in sorted(drawn):
        low, middle, high = np.percentile(drawn[name], (25, 50, 75))
        print(f"{name:50} {low:9.4g} {middle:9.4g} {high:9.4g}")


def details(rows, tuned=(), before=()):
    sums(rows)
    for (machine, planets), members in grouped(rows, lambda r: (r["machine"], r["planets"])).items():
        print(f"\n{machine}, {planets} planets: named first")
        confusion(members)
    print("\nseverity found at 90 %, of one damage on the first line's units")
    first = [r for r in rows if r["part"].startswith(FIRST_LINE) and not r["sound"]]
    for planets, members in grouped(first, lambda r: r["planets"]).items():
        print(f"{planets} planets")
        found_at(members)
    print("\nconfidence")
    reliability(rows)
    seen([row for row in rows if row["part"] in ("above_visible", "below_visible")])
    if tuned:
        beside(rows, tuned, before)
