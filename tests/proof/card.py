"""The score card: figures of marked cases beside their targets."""
import math
import statistics

ANY = "-"  # no target: for comparison
TARGETS = [  # quantity, key, target as text, whether a value meets it
    ("false alarms on nulls", "false_alarms", "0", lambda v: v == 0),
    ("self-null answered NULL", "self_null", ">= 95 %", lambda v: v >= 0.95),
    ("detection at 7 dB and above", "detection", ">= 90 %", lambda v: v >= 0.9),
    ("the same on nulls", "null_detected", ANY, lambda v: True),
    ("localisation, given detection at 7 dB and above", "localisation", ">= 90 %", lambda v: v >= 0.9),
    ("naming top-1 at 7 dB and above", "top1_loud", ">= 90 %", lambda v: v >= 0.9),
    ("the same, by no other name that fits", "own_name_loud", ANY, lambda v: True),
    ("naming top-3 at 7 dB and above", "top3_loud", ">= 97 %", lambda v: v >= 0.97),
    ("naming top-1 at 3 dB", "top1_3", ">= 70 %", lambda v: v >= 0.7),
    ("naming top-3 at 3 dB", "top3_3", ">= 90 %", lambda v: v >= 0.9),
    ("naming top-1 below 2.5 dB", "top1_low", ANY, lambda v: True),
    ("wrong name", "wrong", "<= 10 %", lambda v: v <= 0.1),
    ("wrong effect listed under another verdict", "wrong_beside", ANY, lambda v: True),
    ("two or three effects: exact set", "exact_set", ">= 65 %", lambda v: v >= 0.65),
    ("two or three effects: F1", "f1", ">= 0.85", lambda v: v >= 0.85),
    ("twins answered CLASS or NOT_RESOLVABLE", "twins", ">= 90 %", lambda v: v >= 0.9),
    ("out of library answered NONE_OF_THE_ABOVE", "outside", ">= 80 %", lambda v: v >= 0.8),
    ("out of library given a name", "outside_wrong", "<= 10 %", lambda v: v <= 0.1),
    ("median error of parameters", "parameter_error", "<= 10 %", lambda v: v <= 0.1),
    ("90 % intervals that hold the truth", "coverage", "83 to 96 %", lambda v: 0.83 <= v <= 0.96),
    ("held-out error that remains where right, as it states it: condition", "remaining_condition", "<= 0.10",
     lambda v: v <= 0.1),
    ("the same: speed left out", "remaining_speed", "<= 0.20",
     lambda v: v <= 0.2),
    ("the same: load left out", "remaining_load", "<= 0.15",
     lambda v: v <= 0.15),
    ("the same: over its floor, median", "over_floor", "<= 1.3", lambda v: v <= 1.3),
    ("bench: named 30 dB below the strongest line", "named_30", "yes: >= half",
     lambda v: v >= 0.5),
    ("the same, 40 dB below", "named_40", ANY, lambda v: True),
    ("five real recordings, three told twice: the published name first", "real", "all", lambda v: v == 1),
    ("seconds per case, mean", "seconds", "<= 45", lambda v: v <= 45),
    ("seconds per case, longest", "longest", ANY, lambda v: True),
]

NOT_OF_BASELINES = {"self_null", "localisation", "remaining_condition", "parameter_error", "coverage", "over_floor",
                    "remaining_speed", "remaining_load", "real", "seconds", "longest"}


def wilson(hits, of, z=1.96):
    """Interval of a share. Source: Wilson, J. Am. Stat. Assoc. 22, 209-212 (1927)."""
    if of == 0:
        return 0.0, 1.0
    p = hits / of
    middle = (p + z * z / (2 * of)) / (1 + z * z / of)
    half = z / (1 + z * z / of) * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return max(0.0, middle - half), min(1.0, middle + half)


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
    below = lambda low, high: [r for r in singles if r["machine"] == "bench"
                               and low < (r["concealment_dB"] or 0) < high]
    shares = {
        "false_alarms": share(nulls, "false_alarm"),
        "self_null": (sum(r["self_null"] == "NULL" for r in rows if r["self_null"]),
                      sum(bool(r["self_null"]) for r in rows)),
        "detection": share(loud, "detected"),
        "null_detected": share(nulls, "detected"),
        "localisation": share([r for r in loud if r["detected"]], "located"),
        "top1_loud": share(loud, "top1"),
        "own_name_loud": share(loud, "own_name"),
        "top3_loud": share(loud, "top3"),
        "top1_3": share(near(2.5, 7), "top1"),
        "top3_3": share(near(2.5, 7), "top3"),
        "top1_low": share(near(-999, 2.5), "top1"),
        "wrong": share(singles, "wrong"),
        "wrong_beside": share(singles, "wrong_beside"),
        "exact_set": share(of("several"), "exact"),
        "twins": share(of("twin"), "right"),
        "outside": share(of("outside"), "right"),
        "outside_wrong": share(of("outside"), "wrong"),
        "coverage": share(singles, "covered"),
        "real": share(of("real"), "right"),
        "named_30": share(below(29, 35), "top1"),
        "named_40": share(below(38, 50), "top1"),
    }
    several = of("several")
    values = {
        "f1": statistics.mean(r["f1"] for r in several) if several else None,
        "parameter_error": median(singles, "parameter_error"),
        **{key: median(rows, key)
           for key in ("remaining_condition", "remaining_speed", "remaining_load")},
        "over_floor": median(rows, "over_floor"),
        "seconds": statistics.mean(r["seconds"] for r in rows) if rows else None,
        "longest": max((r["seconds"] for r in rows), default=None),
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
                yield quantity, "no cases", target, False, of_others
                continue
            low, high = wilson(hits, of)
            yield (quantity, f"{hits}/{of} = {100 * hits / of:.0f} % ({100 * low:.0f} to "
                   f"{100 * high:.0f})", target, meets(hits / of), of_others)
        elif values[key] is None:
            yield quantity, "no cases", target, False, of_others
        else:
            yield quantity, f"{values[key]:.3g}", target, meets(values[key]), of_others


def card_markdown(rows, baselines):
    """The card as README.md shows it."""
    lines = ["| quantity | must | `rvbench explain` | " + " | ".join(baselines) + " |",
             "|---" * (3 + len(baselines)) + "|"]
    for quantity, value, target, met, others in card_lines(rows, baselines):
        told = value if met else f"**{value}**, not met"
        lines.append(f"| {quantity} | {target} | {told} | " + " | ".join(others) + " |")
    return "\n".join(lines)
