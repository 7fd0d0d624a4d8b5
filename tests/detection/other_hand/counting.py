"""What answers amount to."""
from collections import defaultdict

import numpy as np

COLUMNS = ("clean", "false alarm", "right", "wrong", "false PASS", "INVALID", "other")
FALSE_ALARMS = 0.03  # that a method may give on the tuning seeds


def key_of(one):
    """Of a specimen or its answer: two of one key are the same recording."""
    of = one if isinstance(one, dict) else vars(one)
    return of["seed"], of["sitting"]


def kind_of(row):
    return "+".join(row["damages"]) or "healthy"


def names(finding):
    return finding.get("one_of") or [finding["component"]]


def is_true(finding, row):
    return bool(set(names(finding)) & set(row["truth"]))


def answer(row):
    """One of COLUMNS."""
    follow = [f for f in row["findings"] if f.get("may_follow_from")]
    findings = row["findings"] if len(follow) > 1 else [f for f in row["findings"] if f not in follow]
    wrong = [f for f in findings if names(f) != ["unknown"] and not is_true(f, row)]
    if not row["truth"]:
        return {"PASS": "clean", "FAIL": "false alarm", "INVALID": "INVALID"}.get(row["verdict"], "other")
    if wrong:
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


def table(rows, key, heads):
    heading("".join(f"{head:22}" for head in heads))
    for group, members in grouped(rows, key).items():
        line("".join(f"{str(name):22}" for name in group), [answer(row) for row in members])


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


def twice(rows):
    """Units that were judged twice, and how many came to the same verdict and parts."""
    both = [pair for pair in grouped(rows, lambda r: r["seed"]).values() if len(pair) == 2]
    same = sum(a["verdict"] == b["verdict"] for a, b in both)
    print(f"judged twice: {len(both)}; the same verdict: {same}")


def seen(rows):
    """Of damage that was made as large as what a sound record said would be seen, how much was shown."""
    def is_shown(row):
        return any(row.get("parts", {}).get(part, ["not_shown"])[-1] != "not_shown" for part in row["truth"])
    for kind, members in grouped(rows, kind_of).items():
        print(f"{members[0]['part']}, {kind}: {len(members)} units; shown: {sum(map(is_shown, members))}")


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
    """rvbench, the methods and the program as it was before, on the same units."""
    rows = [row for row in rows if "methods" in row]
    asked = {key_of(row) for row in rows}
    answers = {"rvbench": [answer(row) for row in rows]}
    for method, limits in usual([r for r in tuned if "methods" in r and not r["truth"]]).items():
        answers[method] = [answer_of_method(row, method, limits) for row in rows]
    if before:
        answers["rvbench before"] = [answer(row) for row in before if key_of(row) in asked]
    print()
    heading(f"{'method':44}")
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


def report(rows, whole=False, tuned=(), before=()):
    table(rows, lambda r: (r["part"] + (" --sound" if r.get("sound") else ""), kind_of(r)), ("part", "kind"))
    if not whole:
        return
    for (machine, planets), members in grouped(rows, lambda r: (r["machine"], r["planets"])).items():
        print(f"\n{machine}, {planets} planets: named first")
        confusion(members)
    print("\nseverity found at 90 %, of one damage on the first line's units")
    first = [r for r in rows if r["machine"] == "rv20e" and not r.get("changes") and not r.get("sound")]
    for planets, members in grouped(first, lambda r: r["planets"]).items():
        print(f"{planets} planets")
        found_at(members)
    print("\nconfidence")
    reliability(rows)
    twice([row for row in rows if row["part"] == "remounted"])
    for part in ("above_visible", "below_visible"):
        seen([row for row in rows if row["part"] == part])
    if tuned:
        beside(rows, tuned, before)
    print("\ndrawn: quartiles")
    quartiles(rows)
