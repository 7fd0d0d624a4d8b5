#!/usr/bin/python3
"""That marks are no kinder than they say."""
import unittest

from marks import REFUSED, mark_case

RUN = {"seconds": 1}


def hidden(name, also=(), bodies=("motor",), parameter="", value=1.0, anywhere=False):
    return {"name": name, "also": list(also), "bodies": list(bodies), "anywhere": anywhere,
            "parameter": parameter, "value": value, "snr_dB": 20, "concealment_dB": 20}


def told(name, one_of=(), where="motor against the housing", parameters=(), rivals=()):
    return {"name": name, "class": list(one_of), "verdict": "CLASS" if one_of else "NAMED",
            "location": {"where": where}, "parameters": list(parameters),
            "rivals": [{"name": rival} for rival in rivals]}


def mark(kind, truths, effects, verdict=None, variant="", machine="bench", **said):
    sealed = {"case": 1, "kind": kind, "machine": machine, "variant": variant, "effects": truths}
    verdict = verdict or (effects[0]["verdict"] if effects else "NULL")
    return mark_case(sealed, {"verdict": verdict, "effects": effects} | said, RUN)


class Singles(unittest.TestCase):
    def test_the_name_is_right(self):
        row = mark("single", [hidden("pin_ripple")], [told("pin_ripple")])
        self.assertTrue(row["top1"] and row["right"] and not row["wrong"])

    def test_a_further_name_is_wrong(self):
        row = mark("single", [hidden("pin_ripple")], [told("pin_ripple"), told("backlash")])
        self.assertTrue(row["top1"] and row["wrong"] and not row["right"])

    def test_what_is_called_miscalibrated_has_no_name(self):
        row = mark("single", [hidden("pin_ripple")], [told("pin_ripple")], "MISCALIBRATED")
        self.assertFalse(row["top1"] or row["top3"] or row["right"] or row["wrong"])

    def test_another_name_that_fits_is_right_and_not_its_own(self):
        row = mark("single", [hidden("a", also=["b"])], [told("b")])
        self.assertTrue(row["top1"] and row["right"] and not row["own_name"])
        row = mark("single", [hidden("a", also=["b"])], [told("a")])
        self.assertTrue(row["own_name"])

    def test_a_wrong_effect_under_another_verdict_is_counted_beside(self):
        row = mark("single", [hidden("a")], [told("b")], "MISCALIBRATED")
        self.assertTrue(row["wrong_beside"] and not row["wrong"])
        row = mark("single", [hidden("a")], [told("a")], "MISCALIBRATED")
        self.assertFalse(row["wrong_beside"])

    def test_a_class_counts_by_its_first_name(self):
        row = mark("single", [hidden("c")], [told("a", ["a", "b", "c"])])
        self.assertTrue(row["top3"] and not row["top1"] and not row["wrong"])
        row = mark("single", [hidden("d")], [told("a", ["a", "b", "c", "d"])])
        self.assertFalse(row["top3"] or row["top1"])

    def test_a_rival_counts_among_three(self):
        row = mark("single", [hidden("b")], [told("a", rivals=["b"])])
        self.assertTrue(row["top3"] and row["wrong"] and not row["top1"])

    def test_silence_is_a_miss(self):
        row = mark("single", [hidden("a")], [])
        self.assertFalse(row["top1"] or row["detected"] or row["right"] or row["wrong"])
        self.assertIs(row["located"], False)


class RealMachines(unittest.TestCase):
    def test_the_published_name_is_claimed_and_first(self):
        right = lambda *said: mark("real", [hidden("a")], *said)["right"]
        self.assertTrue(right([told("a"), told("b")]))
        self.assertFalse(right([told("b"), told("a")]))
        self.assertFalse(right([told("b", ["b", "a"])]))
        self.assertFalse(right([told("a")], "MISCALIBRATED"))
        self.assertFalse(right([]))


class Places(unittest.TestCase):
    def located(self, where, **truth):
        return mark("single", [hidden("a", **truth)], [told("a", where=where)])["located"]

    def test_bodies_are_compared_and_not_what_they_are_told_by(self):
        self.assertTrue(self.located("motor and input_shaft"))
        self.assertFalse(self.located("brake against the housing, by motor_torque"))

    def test_mirrored_places_are_one_and_many_are_none(self):
        either = "planet_1 and carrier, by stage_1 or planet_2 and carrier, by stage_2"
        self.assertTrue(self.located(either, bodies=["planet_2", "carrier"]))
        self.assertFalse(self.located("brake or carrier or motor"))

    def test_both_of_two_alike_hold_each(self):
        alike = "planet_1 and carrier, planet_2 and carrier alike"
        self.assertTrue(self.located(alike, bodies=["planet_1", "planet_2", "carrier"]))

    def test_nothing_is_asked_of_what_acts_nowhere_or_anywhere(self):
        self.assertIsNone(self.located("brake", bodies=[]))
        self.assertIsNone(self.located("brake", anywhere=True))


class Sizes(unittest.TestCase):
    def test_an_interval_holds_the_truth_or_not(self):
        for low, covered in ((0.9, True), (1.05, False)):
            size = {"name": "depth", "value": 1.1, "ci90": [low, 1.2]}
            row = mark("single", [hidden("a", parameter="depth")], [told("a", parameters=[size])])
            self.assertEqual(row["covered"], covered)
            self.assertAlmostEqual(row["parameter_error"], 0.1)

    def test_no_interval_holds_nothing(self):
        size = {"name": "depth", "value": 1.1, "ci90": None}
        row = mark("single", [hidden("a", parameter="depth")], [told("a", parameters=[size])])
        self.assertFalse(row["covered"])

    def test_a_quantity_that_is_not_there_stops_the_score(self):
        size = {"name": "depth", "value": 1.1, "ci90": [1, 2]}
        with self.assertRaises(SystemExit):
            mark("single", [hidden("a", parameter="level")], [told("a", parameters=[size])])


    def test_what_may_act_anywhere_has_no_one_size(self):
        size = {"name": "depth", "value": 1.1, "ci90": [1, 2]}
        truth = hidden("a", parameter="depth", anywhere=True)
        row = mark("single", [truth], [told("a", parameters=[size])])
        self.assertNotIn("parameter_error", row)


class HeldOut(unittest.TestCase):
    def test_each_error_has_the_floor_of_what_was_left_out(self):
        fit = {"held_out": {"before": 3, "after": 1.2, "floor": 1,
                            "speeds": {"before": 5, "after": 3, "floor": 2.5},
                            "loads": {"before": 2, "after": 1.5, "floor": 2.5}}}
        row = mark("single", [hidden("a")], [told("a")], fit=fit)
        self.assertAlmostEqual(row["remaining_condition"], 0.1)
        self.assertAlmostEqual(row["remaining_speed"], 0.2)
        self.assertNotIn("remaining_load", row)
        self.assertAlmostEqual(row["over_floor"], 1.2)


class Several(unittest.TestCase):
    TRUTHS = [hidden("a"), hidden("b")]

    def test_the_set_is_exact(self):
        row = mark("several", self.TRUTHS, [told("b"), told("a")])
        self.assertTrue(row["exact"] and row["f1"] == 1)

    def test_one_effect_in_two_lines_is_one(self):
        row = mark("several", self.TRUTHS, [told("b"), told("a"), told("b", where="twice a turn")])
        self.assertTrue(row["exact"])

    def test_one_answer_is_no_two(self):
        row = mark("several", [hidden("a", also=["b"]), hidden("b", also=["a"])], [told("a")])
        self.assertFalse(row["exact"])
        self.assertAlmostEqual(row["f1"], 2 / 3)

    def test_one_more_is_one_too_many(self):
        row = mark("several", self.TRUTHS, [told("a"), told("b"), told("c")])
        self.assertTrue(row["wrong"] and not row["exact"])
        self.assertAlmostEqual(row["f1"], 0.8)


class OtherKinds(unittest.TestCase):
    def test_a_null_is_null(self):
        self.assertTrue(mark("null", [], [])["right"])
        for verdict in ("NONE_OF_THE_ABOVE", REFUSED):
            self.assertTrue(mark("null", [], [], verdict)["false_alarm"])
        self.assertTrue(mark("null", [], [told("a")])["false_alarm"])

    def test_only_nuisances_excuse_miscalibrated(self):
        self.assertTrue(mark("null", [], [], "MISCALIBRATED", "strong")["right"])
        row = mark("null", [], [], "MISCALIBRATED", "clean")
        self.assertFalse(row["right"] or row["false_alarm"])

    def test_outside_has_no_name(self):
        self.assertTrue(mark("outside", [hidden("x")], [], "NONE_OF_THE_ABOVE")["right"])
        row = mark("outside", [hidden("x")], [told("slip")], "NONE_OF_THE_ABOVE")
        self.assertTrue(row["wrong"] and not row["right"])

    def test_twins_are_a_class_of_nothing_else(self):
        truth = [hidden("a", also=["b"])]
        self.assertTrue(mark("twin", truth, [told("b", ["b", "a"])])["right"])
        self.assertTrue(mark("twin", truth, [], "NOT_RESOLVABLE")["right"])
        for effects in ([told("a")], [told("a", ["a", "b", "c"])],
                        [told("a", ["a", "b"]), told("c")]):
            self.assertFalse(mark("twin", truth, effects)["right"])


if __name__ == "__main__":
    unittest.main()
