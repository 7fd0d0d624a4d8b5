"""What a recording of another hand holds, and what it must not give away."""
import functools
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from draws import TURN, Draws  # noqa: E402
from housing import Housing, fast_length  # noqa: E402
from machines import PlanetaryStage, RvReducer, TwoStageTrain  # noqa: E402
from methods import INNER_RACE, OWN_LINES, PLAIN  # noqa: E402
from card import card_markdown  # noqa: E402
from counting import answer, answer_of_method, has_race_spacing, is_excused, is_same_answer, parts_found, \
    usual  # noqa: E402
from parts import FIRST_LINE, KINDS, PARTS, SCORE, SHORT, TUNING, short_units, sound_units, specimens  # noqa: E402
from sources import Forces, Race, blows  # noqa: E402
from unit import RATE_HZ, Unit  # noqa: E402

TURNS = 121
ASKING = ("score", "asking.py", "card.py", "counting.py", "methods.py", "__pycache__")  # what writes no recording


def line_powers(force):
    """Powers of the orders k/121 of a force over one output turn."""
    return 2 * np.abs(np.fft.rfft(force) / len(force)) ** 2


def forces_over_one_output_turn(planets, damages):
    """Forces of an RV-20E with equal planets, equal discs and no healthy modulation."""
    machine = RvReducer(Draws(3), planets)
    machine.planets.mesh.gains[:] = 1
    machine.pin_mesh.gains[:] = 1
    for modulation in (machine.planets.modulation, machine.pin_modulation):
        modulation.depths = [(0.0, 0.0)] * len(modulation.depths)
    turns = np.arange(TURNS * 512) / 512
    return machine, machine.forces(turns, 10.0, 1.0, 1e6, 0, damages)


class SoundMesh(unittest.TestCase):
    def test_two_equal_planets_cancel_odd_harmonics(self):
        _, forces = forces_over_one_output_turn(2, {})
        power = line_powers(forces.mesh["sun-planet mesh"])
        self.assertLess(power[1080], 1e-12 * power[2160])

    def test_three_equal_planets_add_all_harmonics(self):
        machine, forces = forces_over_one_output_turn(3, {})
        power = line_powers(forces.mesh["sun-planet mesh"])
        self.assertAlmostEqual(power[1080], 4.5 * machine.planets.mesh.amplitudes[0] ** 2, places=9)

    def test_a_path_that_turns_brings_odd_harmonics_back_beside_their_order(self):
        machine, forces = forces_over_one_output_turn(2, {})
        power = line_powers(forces.mesh["sun-planet mesh, cosine"])
        expected = 0.5 * (machine.planets.share * machine.planets.mesh.amplitudes[0]) ** 2
        self.assertAlmostEqual(power[1079], expected, places=9)
        self.assertAlmostEqual(power[1081], expected, places=9)

    def test_two_equal_discs_pass_their_pins_together(self):
        machine, forces = forces_over_one_output_turn(2, {})
        power = line_powers(forces.mesh["pin pass"])
        self.assertAlmostEqual(power[1560], 2 * machine.pin_mesh.amplitudes[0] ** 2, places=9)


class Damage(unittest.TestCase):
    def test_a_bent_shaft_modulates_each_planets_mesh_once_per_turn_of_the_sun(self):
        machine, forces = forces_over_one_output_turn(2, {"shaft": 1})
        power = line_powers(forces.damage["sun-planet mesh"])
        side = 0.5 * (2 * 0.35 * machine.planets.mesh.amplitudes[0]) ** 2
        self.assertAlmostEqual(power[1080 - 120], side, places=9)
        self.assertLess(power[1080], 1e-9 * side)

    def test_a_struck_pin_is_struck_once_per_orbit_by_each_disc(self):
        _, forces = forces_over_one_output_turn(2, {"pin": 1})
        power = line_powers(forces.damage["struck pin"])
        self.assertGreater(power[78], 1e6 * power[39])
        self.assertGreater(power[78], 1e6 * power[40])

    def test_a_struck_tooth_strikes_once_per_turn_of_its_planet_against_the_carrier(self):
        _, forces = forces_over_one_output_turn(2, {"tooth": 1})
        power = line_powers(forces.damage["sun-planet mesh"])
        comb = power[40:40 * 30:40]
        self.assertGreater(comb.min(), 1e3 * np.delete(power, np.arange(0, len(power), 40)).max())

    def test_a_blow_has_fallen_to_1_e_at_its_width(self):
        for is_gaussian in (False, True):
            self.assertAlmostEqual(float(blows(np.array([2.01]), 0.01, is_gaussian)[0]), np.exp(-1), places=9)

    def test_inner_and_outer_race_add_to_the_number_of_balls(self):
        inner, outer = (Race(Draws(1), "race", 11, 5 / 26, is_inner) for is_inner in (True, False))
        self.assertAlmostEqual(inner.order + outer.order, 11)

    def test_a_race_is_struck_at_its_order_less_the_slip(self):
        race = Race(Draws(1), "race", 11, 5 / 26, is_inner=False)
        turns = np.arange(200_000) / 1000
        force = race.force(turns, 1.0, 1.0, 4960, 0)
        expected = race.order * (1 - race.slip) * turns[-1]
        self.assertAlmostEqual(np.count_nonzero(force), expected, delta=0.02 * expected)

    def test_half_the_severity_halves_the_force(self):
        for kind in ("shaft", "tooth", "pin", "race"):
            whole, half = (forces_over_one_output_turn(2, {kind: severity})[1] for severity in (1, 0.5))
            for place in whole.damage:
                np.testing.assert_allclose(half.damage[place], 0.5 * whole.damage[place], atol=1e-9)


class OneHousing(unittest.TestCase):
    def test_a_force_far_above_a_mode_is_heard_as_mass_and_below_as_its_second_derivative(self):
        housing = Housing(Draws(5), 1)
        housing.natural_Hz[:], housing.damping[:] = 200.0, 0.01
        weights = housing.at_sensors[0] * housing.draws.normal("mode shapes at here", housing.modes)
        seconds = np.arange(fast_length(20_000)) / 10_000
        for frequency_Hz, answer in ((4000.0, 1.0), (2.0, (2 / 200) ** 2)):
            frequency_Hz = round(frequency_Hz * seconds[-1]) / (len(seconds) / 10_000)  # whole periods
            heard = housing.accelerations({"here": np.cos(TURN * frequency_Hz * seconds)}, 10_000)[0]
            self.assertAlmostEqual(np.max(np.abs(heard)) / abs(weights.sum()), answer, delta=0.05 * answer)


class OneUnit(unittest.TestCase):
    def test_damage_changes_nothing_else_of_a_unit(self):
        machine = functools.partial(RvReducer, planets=2)
        sound, bad = (Unit(machine, 7, channels=2).record(0, 1815, 100, damages) for damages in ({}, {"tooth": 1}))
        np.testing.assert_array_equal(sound.mesh, bad.mesh)
        np.testing.assert_array_equal(sound.noise, bad.noise)
        self.assertEqual(np.max(np.abs(sound.damage)), 0)

    def test_a_record_holds_four_output_turns(self):
        record = Unit(functools.partial(RvReducer, planets=2), 7, channels=1).record(0, 1815, 100, {})
        self.assertGreater(record.turns[-1] - record.turns[0], 4 * 121)
        self.assertGreater(record.mesh.shape[1], 4 * 121 / 30.25 * RATE_HZ)

    def test_the_other_machines_have_each_kind_of_damage(self):
        for machine in (TwoStageTrain, PlanetaryStage):
            for kind in machine.parts:
                with self.subTest(machine=machine.__name__, kind=kind):
                    turns = np.arange(20_000) / 500
                    forces = machine(Draws(2)).forces(turns, 20.0, 1.0, 10_000, 0, {kind: 1})
                    self.assertIsInstance(forces, Forces)
                    self.assertGreater(max(np.max(np.abs(f)) for f in forces.damage.values()), 0)


class Files(unittest.TestCase):
    def test_the_recording_is_written_without_the_project_and_keeps_its_truth_to_itself(self):
        with tempfile.TemporaryDirectory() as scratch:
            alone = Path(scratch, "alone")
            shutil.copytree(HERE, alone, ignore=shutil.ignore_patterns(*ASKING))
            given, truth = Path(scratch, "given"), Path(scratch, "truth")
            subprocess.run([alone / "generate", given, truth, "--machine", "planetary", "--kind", "ring"], check=True,
                           cwd=scratch)
            self.assertEqual(json.loads((truth / "truth.json").read_text())["parts"], ["ring_gear"])
            self.assertEqual(sorted(path.name for path in given.iterdir()), ["kinematics.json", "recording.h5"])
            with h5py.File(given / "recording.h5") as file:
                attributes = {name for point in file["points"].values() for name in point.attrs}
            self.assertEqual(attributes, {"speed_rpm", "load_pct", "repeat", "status"})


class PlainMethods(unittest.TestCase):
    def test_the_envelope_methods_name_the_race_that_rings_a_mode_once_per_ball(self):
        rate_Hz, turns_Hz = 4960, 20
        seconds = np.arange(30 * rate_Hz) / rate_Hz
        draws = np.random.default_rng(3)  # blows that slip, or prewhitening takes them out as lines
        blow_s = np.cumsum(1 + 0.01 * draws.standard_normal(5000)) / (INNER_RACE * turns_Hz)
        since_blow = seconds - np.concatenate([[-1], blow_s])[np.searchsorted(blow_s, seconds)]
        noise = draws.standard_normal(len(seconds))
        ringing = 4 * np.exp(-200 * since_blow) * np.sin(TURN * 1200 * since_blow) + noise
        for method in ("envelope in the band of highest kurtosis", "cepstrum prewhitening"):
            sound, bad = (PLAIN[method](samples, turns_Hz * seconds) for samples in (noise, ringing))
            with self.subTest(method=method):
                self.assertGreater(bad["bearing_inner"], sound["bearing_inner"] + 2)
                self.assertEqual(max(bad, key=bad.get), "bearing_inner")

    def test_own_lines_are_those_of_no_sound_part(self):
        for h in range(1, 4):
            for line in (1080 * h, 1560 * h, 1080 * h + 120, 1080 * h - 40, 1560 * h + 39):
                for part in ("sun_gear", "planet_gear", "pin_housing"):
                    self.assertNotIn(line, OWN_LINES[part])

    def test_the_limits_of_a_method_let_three_of_a_hundred_sound_units_alarm(self):
        draws = np.random.default_rng(4)
        rows = [{"truth": [], "methods": {"m": {"a": float(draws.normal()), "b": 100 * float(draws.normal())}}}
                for _ in range(100)]
        limits = usual(rows)["m"]
        answers = [answer_of_method(row, "m", limits) for row in rows]
        self.assertIn(answers.count("false alarm"), (2, 3))
        bad = {"truth": ["b"], "methods": {"m": {"a": 0.0, "b": 1000.0}}}
        self.assertEqual(answer_of_method(bad, "m", limits), "right")


class Score(unittest.TestCase):
    def test_seeds_meet_only_where_units_of_the_first_line_are_asked_again(self):
        first_line = {s.seed for base in (TUNING, SCORE) for part in FIRST_LINE
                      for s in specimens(part, base)}
        units = [s for base in (TUNING, SCORE) for part in PARTS for s in specimens(part, base)]
        units += [s for base in (TUNING, SCORE) for machine in KINDS for s in sound_units(machine, 3, base)]
        units += short_units(SHORT)
        self.assertEqual(len(first_line), 4 * 250)
        seeds = [(s.seed, s.sitting) for s in units if s.seed not in first_line]
        self.assertEqual(len(seeds), len(set(seeds)))
        again = {s.part for s in units if s.seed in first_line}
        self.assertEqual(again, {*FIRST_LINE, "angle_noise", "dead_channel", "clipped_channel",
                                 "six_sensors", "three_sensors", "one_sensor"})

    def test_units_that_are_asked_again_are_those_of_the_first_line_but_for_the_change(self):
        (unit,) = [s for s in specimens("dead_channel", SCORE) if s.number == 99]
        (first,) = [s for s in specimens("three_planets", SCORE) if s.seed == unit.seed]
        self.assertEqual(replace(first, part=unit.part, number=99, changes={"dead_channel": True}), unit)
        self.assertEqual(unit.damages, {"race": 1.0})
        self.assertEqual(len(specimens("angle_noise", SCORE)), 50)
        self.assertEqual(sum(not s.damages for s in specimens("one_sensor", SCORE)), 100)
        self.assertEqual(len(specimens("one_sensor", SCORE)), 200)

    def test_an_answer_is_right_only_if_the_first_finding_is(self):
        def row(verdict, *named, truth=("pin_housing",)):
            return {"truth": list(truth), "verdict": verdict, "findings": [{"component": name} for name in named]}
        self.assertEqual(answer(row("FAIL", "pin_housing")), "right")
        self.assertEqual(answer(row("FAIL", "pin_housing", "crank")), "wrong")
        self.assertEqual(answer(row("INVALID", "crank")), "wrong")
        self.assertEqual(answer(row("PASS")), "false PASS")
        self.assertEqual(answer(row("INVALID")), "INVALID")
        self.assertEqual(answer(row("PASS", truth=())), "clean")
        self.assertEqual(answer(row("FAIL", "crank", truth=())), "false alarm")
        self.assertEqual(answer(row("INVALID", "crank", truth=())), "false alarm")
        self.assertEqual(answer(row("INVALID", truth=())), "INVALID")
        self.assertEqual(answer(row("INVALID", "unknown", truth=())), "INVALID")
        self.assertEqual(answer(row("exit 139", truth=())), "other")

    def test_one_finding_may_follow_from_the_first_and_no_more(self):
        def row(*following):
            findings = [{"component": "pin_housing"}]
            findings += [{"component": part, "may_follow_from": "pin_housing: pin_damage"} for part in following]
            return {"truth": ["pin_housing"], "verdict": "FAIL", "findings": findings}
        self.assertEqual(answer(row("crank")), "right")
        self.assertTrue(is_excused(row("crank")))
        self.assertFalse(is_excused(row()))
        self.assertEqual(answer(row("crank", "sun_gear")), "wrong")
        of_another = row("crank")
        of_another["findings"][1]["may_follow_from"] = "sun_gear: profile_error"
        self.assertEqual(answer(of_another), "wrong")

    def test_an_answer_is_the_same_if_the_verdict_and_the_first_part_are(self):
        def row(verdict, *named):
            return {"verdict": verdict, "findings": [{"component": name} for name in named]}
        self.assertTrue(is_same_answer(row("FAIL", "crank", "sun_gear"), row("FAIL", "crank")))
        self.assertFalse(is_same_answer(row("FAIL", "crank"), row("FAIL", "sun_gear")))
        self.assertFalse(is_same_answer(row("FAIL", "crank"), row("INVALID", "crank")))

    def test_two_bad_parts_want_a_finding_each(self):
        def row(*named):
            findings = [{"component": of[0], "one_of": of} for of in named]
            return {"truth": ["sun_gear", "planet_gear"], "findings": findings}
        self.assertEqual(parts_found(row(["sun_gear", "planet_gear"])), 1)
        self.assertEqual(parts_found(row(["planet_gear"], ["sun_gear", "planet_gear"])), 2)
        self.assertEqual(parts_found(row(["sun_gear"])), 1)
        self.assertEqual(parts_found(row(["planet_gear"])), 1)
        self.assertEqual(parts_found(row(["crank"])), 0)
        self.assertEqual(parts_found(row()), 0)

    def test_an_unknown_family_is_the_races_if_it_is_spaced_and_slips_as_its_blows(self):
        def row(spacing, kind="bearing-like"):
            return {"race_order": 1.9, "unknown": [{"spacing": spacing, "kind": kind}]}
        self.assertTrue(has_race_spacing(row(1.915)))
        self.assertFalse(has_race_spacing(row(1.925)))
        self.assertFalse(has_race_spacing(row(1.9, "gear-like")))

    def test_health_and_planets_are_drawn_apart(self):
        for part in ("hum", "tone", "loud_noise", "remounted"):
            kinds = {(s.planets, *s.damages) for s in specimens(part, SCORE)}
            self.assertEqual(len(kinds), 2 * (1 + len(KINDS["rv20e"])))

    def test_the_card_tells_what_is_met_what_is_not_and_what_was_not_asked_yet(self):
        def healthy(clean, of):
            return [{"part": "two_planets", "seed": n, "sound": False, "truth": [], "damages": {}, "findings": [],
                     "verdict": "PASS" if n < clean else "FAIL"} for n in range(of)]
        def first_line_of_card(rows):
            return card_markdown(rows).splitlines()[2]
        self.assertIn("| 196 of 200 |", first_line_of_card(healthy(196, 200)))
        self.assertIn("| **195 of 200**, not met |", first_line_of_card(healthy(195, 200)))
        self.assertIn("| 99 of 99 so far |", first_line_of_card(healthy(99, 99)))
        self.assertIn("| 201 of 201, which is more than", first_line_of_card(healthy(201, 201)))
        self.assertNotIn("planetary", card_markdown(healthy(200, 200)))


if __name__ == "__main__":
    unittest.main()
