"""The score card: counts beside what was asked for."""
from dataclasses import dataclass
from typing import Callable

from counting import SURE, answer, grouped, has_race_spacing, is_excused, is_same_answer, is_shown, is_true, \
    kind_of, named, names, pairs_of, parts_found, plain_of
from parts import FIRST_LINE, KINDS

HALF = ("two_planets_half", "three_planets_half")


@dataclass
class Line:
    quantity: str
    asked: str  # in words
    count: Callable  # rows: (how many, of how many)
    is_met: Callable  # how many, of how many
    units: int = 0  # that are to be asked; 0: as many as there are

    def counted(self, rows):
        """In words; nothing where no unit was asked."""
        count, total = self.count(rows)
        if not total:
            return ""
        if self.units and total > self.units:
            return f"{count} of {total}, which is more than are to be asked"
        if total < self.units:
            return f"{count} of {total} so far"
        return f"{count} of {total}" if self.is_met(count, total) else f"**{count} of {total}**, not met"


def share(of, is_one):
    """Rows that are asked, and which of them count."""
    return lambda rows: (sum(1 for row in rows if of(row) and is_one(row)), sum(1 for row in rows if of(row)))


def at_least(bound, of):
    return f"at least {bound} of {of}", lambda count, _: count >= bound, of


def at_most(bound, of):
    return f"at most {bound} of {of}", lambda count, _: count <= bound, of


def line(quantity, asked, count):
    words, is_met, units = asked
    return Line(quantity, words, count, is_met, units)


def within(parts, *, sound=False, bad=None):
    """bad: faulty units alone, or sound ones; None: all."""
    return lambda row: (row["part"] in parts and row["sound"] == sound
                        and (bad is None or bool(row["truth"]) == bad))


def is_answer(*columns):
    return lambda row: answer(row) in columns


def fewest_of_a_kind(of):
    """Right answers of the kind that has the fewest."""
    def count(rows):
        kinds = grouped([row for row in rows if of(row)], kind_of).values()
        if len(kinds) < len(KINDS["rv20e"]):
            return 0, 0
        return min((sum(answer(row) == "right" for row in kind), len(kind)) for kind in kinds)
    return count


def sets_among_right(of):
    return share(lambda row: of(row) and answer(row) == "right", lambda row: len(names(row["findings"][0])) > 1)


def a_quarter():
    return "at most a quarter", lambda count, total: 4 * count <= total, 0


def first_lines(sound):
    bad, good, both = (within(FIRST_LINE, sound=sound, bad=b) for b in (True, False, None))
    after = ", with `--sound`" if sound else ""
    return [
        line(f"RV-20E{after}: healthy units clean", at_least(196, 200), share(good, is_answer("clean"))),
        line(f"RV-20E{after}: bad units right", at_least(285, 300), share(bad, is_answer("right"))),
        line("- of the kind with the fewest", at_least(54, 60), fewest_of_a_kind(bad)),
        line("- wrong", at_most(6, 300), share(bad, is_answer("wrong"))),
        line("- false PASS", at_most(6, 300), share(bad, is_answer("false PASS"))),
        line("- sets among the right ones", a_quarter(), sets_among_right(bad)),
        line("- a second finding that may follow from the first", at_most(60, 300), share(bad, is_excused)),
        line("- INVALID, healthy ones too", at_most(10, 500), share(both, is_answer("INVALID"))),
    ]


def half_lines():
    plain, sound = (within(HALF, sound=s) for s in (False, True))
    return [
        line("half the severity: right", at_least(240, 300), share(plain, is_answer("right"))),
        line("- wrong", at_most(12, 300), share(plain, is_answer("wrong"))),
        line("- false PASS", at_most(45, 300), share(plain, is_answer("false PASS"))),
        line("- right with `--sound`", at_least(264, 300), share(sound, is_answer("right"))),
        line("- wrong with `--sound`", at_most(12, 300), share(sound, is_answer("wrong"))),
    ]


def bearing_lines():
    of = within(("other_bearing",))
    return [line("spalled bearing of another geometry: PASS", at_most(0, 60), share(of, is_answer("false PASS"))),
            line("- `unknown` with the race's spacing, or the right part", at_least(48, 60),
                 share(of, lambda row: answer(row) == "right" or has_race_spacing(row) and answer(row) != "wrong"))]


def machine_lines():
    lines = []
    for name, part in (("another RV", "other_rv"), ("two-stage train", "two_stage"), ("planetary stage", "planetary")):
        good, bad = (within((part,), bad=b) for b in (False, True))
        lines += [line(f"{name}: healthy units clean", at_least(57, 60), share(good, is_answer("clean"))),
                  line("- bad units right", at_least(85, 100), share(bad, is_answer("right"))),
                  line("- wrong", at_most(5, 100), share(bad, is_answer("wrong")))]
    return lines


def pair_lines():
    of = within(("pairs",))
    return [
        line("two bad parts: one named", at_least(90, 100), share(of, lambda row: parts_found(row) > 0)),
        line("- both named", at_least(50, 100), share(of, lambda row: parts_found(row) > 1)),
        line("- a third named", at_most(5, 100), share(of, lambda row: any(not is_true(f, row) for f in named(row)))),
    ]


def twice(rows):
    both = pairs_of(rows)
    return sum(one["verdict"] == other["verdict"] for one, other in both), len(both)


def the_same(part):
    def count(rows):
        plain = plain_of(rows)
        again = [row for row in rows if row["part"] == part and not row["sound"] and row["seed"] in plain]
        return sum(is_same_answer(plain[row["seed"]], row) for row in again), len(again)
    return count


def again_lines():
    return [
        line("judged twice, sensors remounted: the same verdict", at_least(97, 100), twice),
        line("a dead channel: the same answer", at_least(95, 100), the_same("dead_channel")),
        line("a clipped channel: the same answer", at_least(95, 100), the_same("clipped_channel")),
        line("0.003 rad of noise on the angle: the same answer", at_least(50, 50), the_same("angle_noise")),
    ]


def disturbed_lines():
    lines = []
    for name, part in (("hum", "hum"), ("a tone", "tone"), ("four times the noise", "loud_noise")):
        good, bad, both = (within((part,), bad=b) for b in (False, True, None))
        lines += [line(f"{name}: wrong, or a false alarm", at_most(3, 100),
                       share(both, is_answer("wrong", "false alarm"))),
                  line("- false PASS", at_most(3, 50), share(bad, is_answer("false PASS")))]
        if part != "loud_noise":
            lines += [line("- bad units right", at_least(40, 50), share(bad, is_answer("right"))),
                      line("- healthy units clean", at_least(45, 50), share(good, is_answer("clean")))]
    return lines


def noise_lines():
    return [
        line("white noise of 0.5 and 1 rms: PASS", at_most(4, 160),
             share(within(("white_half", "white_one")), is_answer("false PASS"))),
        line("- of 2 and 4 rms: PASS", at_most(0, 160),
             share(within(("white_two", "white_four")), is_answer("false PASS"))),
        line("- of 0.5 rms: right", at_least(64, 80), share(within(("white_half",)), is_answer("right"))),
        line("1.0 to 1.5 times what would just be seen: shown", at_least(180, 200),
             share(within(("above_visible",)), is_shown)),
        line("0.4 to 0.6 times: shown", at_most(120, 200),
             share(within(("below_visible",)), lambda row: row["verdict"] == "cannot tell" or is_shown(row))),
    ]


def sure_findings(rows):
    sure = [is_true(f, row) for row in rows for f in row["findings"] if (f.get("confidence") or 0) >= SURE]
    return sum(sure), len(sure)


def confidence_lines():
    right = within(FIRST_LINE, bad=True)
    return [
        Line(f"findings with a confidence of at least {SURE}: right", "at least 90 %", sure_findings,
             lambda count, total: count >= 0.9 * total),
        Line("- right answers of the first line that have it", "at least half",
             share(lambda row: right(row) and answer(row) == "right",
                   lambda row: (row["findings"][0].get("confidence") or 0) >= SURE),
             lambda count, total: 2 * count >= total),
    ]


LINES = [*first_lines(False), *first_lines(True), *half_lines(), *bearing_lines(), *machine_lines(), *pair_lines(),
         *again_lines(), *disturbed_lines(), *noise_lines(), *confidence_lines()]


def card_markdown(rows):
    """A line each, but for those that nothing was asked for yet."""
    lines = ["| what | asked | counted |", "|---|---|---|"]
    lines += [f"| {one.quantity} | {one.asked} | {counted} |" for one in LINES if (counted := one.counted(rows))]
    return "\n".join(lines)


def sensors_markdown(rows):
    """The same units by fewer sensors; nothing where none were asked."""
    plain = plain_of(rows)
    lines = ["| sensors | clean | right | wrong | false PASS | INVALID |", "|---|---|---|---|---|---|"]
    groups = grouped([row for row in rows if "channels" in row["changes"]], lambda row: row["changes"]["channels"])
    if not groups:
        return ""
    of_twelve = {row["seed"] for members in groups.values() for row in members}
    groups[12] = [plain[seed] for seed in sorted(of_twelve) if seed in plain]
    for sensors, members in sorted(groups.items(), reverse=True):
        answers = [answer(row) for row in members]
        wrong = answers.count("wrong") + answers.count("false alarm")
        lines.append(f"| {sensors} | {answers.count('clean')} of {sum(not row['truth'] for row in members)} | "
                     f"{answers.count('right')} of {sum(bool(row['truth']) for row in members)} | {wrong} | "
                     f"{answers.count('false PASS')} | {answers.count('INVALID')} |")
    return "\n".join(lines)
