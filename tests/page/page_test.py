#!/usr/bin/env python3
"""The operator page from end to end, in a headless Chromium, by the keyboard alone.

    page_test.py --page bench/serve/page [--plots FOLDER] [--shots FOLDER] [--against real
                 --program rvbench] [unittest's arguments]

Without --against real a fake station answers.
"""
import argparse
import json
import pathlib
import re
import sys
import time
import unittest

from browser import Browser, Keys
from stations import FakeStation, RealStation

OPTIONS = argparse.Namespace()
LANGUAGES = ("en", "zh", "ja")
# Words of refusals that the page never meets, for it asks in due form.
FOR_PROGRAMS = {"host", "origin", "method", "malformed", "bad_request", "target_too_long", "ranges", "header_twice",
                "length_required", "content_length", "body_too_large", "expected_json"}
# What a browser that nobody is logged in with is refused.
NOT_LOGGED_IN = (("/favicon.ico", 404), ("/api/session", 401))


def words_of(language):
    text = (OPTIONS.page / "words" / f"{language}.json").read_text(encoding="utf-8")
    return json.loads(text, object_pairs_hook=without_twins)


def without_twins(pairs):
    """Of two words of one key the page would say the last, and nobody would miss the other."""
    words = dict(pairs)
    if len(words) < len(pairs):
        keys = [key for key, _ in pairs]
        raise ValueError(f"there twice: {sorted({key for key in keys if keys.count(key) > 1})}")
    return words


class Words(unittest.TestCase):
    """The three files of words say the same things."""

    def test_the_same_keys_in_the_same_order(self):
        keys = list(words_of("en"))
        for language in ("zh", "ja"):
            self.assertEqual(keys, list(words_of(language)), language)

    def test_the_same_placeholders(self):
        english = words_of("en")
        for language in ("zh", "ja"):
            for key, text in words_of(language).items():
                places = [sorted(re.findall(r"{\w+}", t)) for t in (english[key], text)]
                self.assertEqual(*places, f"{language}: {key}")

    def test_nothing_is_left_untranslated(self):
        english = words_of("en")
        for language in ("zh", "ja"):
            same = [key for key, text in words_of(language).items() if text == english[key]]
            self.assertEqual([], same, language)

    def test_every_word_the_page_asks_for_is_there(self):
        html = (OPTIONS.page / "index.html").read_text()
        asked = set(re.findall(r'data-word(?:-label|-hint)?="([^"]+)"', html))
        for module in (OPTIONS.page / "js").glob("*.js"):
            asked |= set(re.findall(r'\bsay\("([^"]+)"', module.read_text()))
        self.assertGreater(len(asked), 60)  # the patterns above still find them
        self.assertEqual(set(), asked - set(words_of("en")))

    def test_there_is_a_sentence_for_each_word_of_the_server(self):
        text = {source.name: source.read_text() for source in OPTIONS.page.parent.glob("*.cpp")}
        refused = re.findall(r'refusal\(\d+, "(\w+)"\)|\{"error", "(\w+)"\}', "".join(text.values()))
        asked = {word for either in refused for word in either if word} - FOR_PROGRAMS
        for source in ("station.cpp", "serial_rule.cpp"):
            asked |= set(re.findall(r'return "(\w+)";', text[source]))
        reasons = set(re.findall(r'\bfail\("(\w+)"', "".join(text.values())))
        self.assertGreater(len(asked), 15)  # the patterns above still find them
        self.assertGreater(len(reasons), 3)
        keys = {f"error.{word}" for word in asked} | {f"reason.{word}" for word in reasons}
        self.assertEqual(set(), keys - set(words_of("en")))


class Source(unittest.TestCase):
    """What a server says can never become markup, nor is there any script or style in the page."""

    def test_no_module_writes_markup(self):
        for module in (OPTIONS.page / "js").glob("*.js"):
            found = re.findall(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function",
                               module.read_text())
            self.assertEqual([], found, module.name)

    def test_no_inline_script_or_style(self):
        html = (OPTIONS.page / "index.html").read_text()
        self.assertNotRegex(html, r"<style|\sstyle=|\son\w+=|<script(?![^>]*\ssrc=)")


class PageTest(unittest.TestCase):
    """One browser for all, a station for each."""

    plots = True
    run_s = 3

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(OPTIONS.shots)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.station = FakeStation(OPTIONS, self.plots, self.run_s)
        self.addCleanup(self.station.close)

    def enter(self, token="engineer-token", language="en"):
        self.words = words_of(language)
        page = self.browser
        page.open(self.station.url)
        page.script("localStorage.setItem('rvbench_language', arguments[0])", language)
        page.driver.delete_all_cookies()
        page.open(self.station.url)
        page.wait_word(self.words["state.login"])
        page.wait("the focus in the field of the token", lambda: page.focused() == "token")
        page.type(token, Keys.ENTER)
        page.wait("the scan field", lambda: page.focused() == "scan_text")

    def scan(self, text):
        self.browser.type(text, Keys.ENTER)

    def start(self, serial, say=None):
        self.scan(serial)
        self.browser.wait_word(say["state.ready"] if say else "READY")
        self.browser.tab_to("start")
        self.browser.type(Keys.ENTER)

    def look(self, name):
        """Nothing is cut or beyond the window of 1024 x 768, and the window does not scroll."""
        self.browser.shoot(name)
        self.assertEqual([], self.browser.overflows(), name)
        self.assertFalse(self.browser.scrolls(), name)


class WholeWay(PageTest):
    def go(self, language):
        page = self.browser
        self.enter(language=language)
        say = self.words
        page.wait_word(say["state.idle"])
        self.look(f"{language}_idle")

        self.scan("A27")
        page.wait_word(say["state.ready"])
        self.assertEqual("A27", page.text("#serial"))
        self.look(f"{language}_ready")

        page.script("window.asked = []; const ask = window.fetch; window.fetch = (url, how) => "
                    "{ window.asked.push(String(url)); return ask(url, how); };")
        self.scan("")  # a scanner that sends Enter twice starts nothing
        self.assertFalse([path for path in page.script("return window.asked") if "start" in path])
        page.wait_word(say["state.ready"])
        self.assertEqual("", page.text("#scan_fault"))
        page.tab_to("start", most=1)
        page.type(Keys.ENTER)
        page.wait_word(say["state.running"])
        page.wait("time left", lambda: re.search(r"\d+:\d\d", page.text("#left")))
        page.wait("a curve", lambda: page.text("#strip_torque output") != "–")
        page.wait("points that are done", lambda: page.script(
            "return document.querySelectorAll('#matrix [data-status=done]').length") > 20)
        page.wait("a spectrum", lambda: page.text("#spectrum output") == "A1 +X")
        self.look(f"{language}_running")

        page.wait_word(say["state.FAIL"])
        self.assertEqual(63, page.script("return document.querySelectorAll('#matrix td .mark').length"))
        self.assertEqual(0, page.script("return document.querySelectorAll('#matrix td [data-status=open]').length"))
        self.assertIn(say["component.input_shaft"], page.text("#findings"))
        self.assertIn(say["mechanism.misalignment"], page.text("#findings"))
        self.assertIn("<b>0.25</b>", page.text("#reason"))  # told as text
        self.assertIn(say["next.FAIL"], page.text("#announcer"))
        self.look(f"{language}_fail")

        page.tab_to("report")
        page.type(Keys.ENTER)
        page.wait("the report in a tab of its own", lambda: len(page.driver.window_handles) == 2)
        url, title = page.new_tab_url()
        self.assertRegex(url, r"/api/runs/A27/\w+/report$")
        self.assertEqual("Report of A27", title)

        self.see_history(language)
        self.see_trend(language)
        self.see_limits(language)

        page.tab_to("skip")
        page.type(Keys.ENTER)
        page.wait("back at the scan field", lambda: page.focused() == "scan_text")
        page.tab_to("next")
        page.type(Keys.ENTER)
        page.wait_word(say["state.idle"])
        self.assertEqual("", page.text("#serial"))
        self.assertEqual([], page.complaints(NOT_LOGGED_IN))

    def see_history(self, language):
        page, say = self.browser, self.words
        page.tab_to("tab_station")
        page.type(Keys.ARROW_RIGHT)
        page.wait("the run that ended", lambda: "A27" in page.text("#history tbody tr:first-child"))
        self.look(f"{language}_history")
        page.tab_to(say["history.rejudge"])
        page.type(Keys.ENTER)
        page.wait("the dialogue", lambda: page.focused() == "rejudge_limits")
        page.tab_to("rejudge_go")
        page.type(Keys.ENTER)
        told = say["rejudge.done"].replace("{before}", say["state.FAIL"]).replace("{now}", say["state.FAIL"])
        page.wait("both judgements", lambda: page.text("#rejudge_told") == told)
        self.look(f"{language}_rejudge")
        page.type(Keys.ESCAPE)
        page.wait("as judged then and again", lambda: say["history.rejudged"] in page.text("#history tbody tr:first-child"))

    def see_trend(self, language):
        page = self.browser
        page.tab_to("tab_history")
        page.type(Keys.ARROW_RIGHT)
        page.wait("values", lambda: "m/s²" in page.text("#trend"))
        self.assertIn("No trend can be told", page.text("#trend_told"))
        self.look(f"{language}_trend")

    def see_limits(self, language):
        page, say = self.browser, self.words
        page.tab_to("tab_trend")
        page.type(Keys.ARROW_RIGHT)
        page.wait("a version", lambda: page.text("#limits tbody tr td"))
        page.tab_to("propose")
        page.type(Keys.ENTER)
        page.wait("the draft", lambda: say["limits.draft"] in page.text("#limits tbody tr:first-child"))
        page.tab_to(say["limits.approve"])
        page.type(Keys.ENTER)
        page.wait("the effect on history", lambda: "7" in page.text("#version_effect"))
        self.assertIn("A14", page.text("#version_changes"))  # which run would change, before approval
        self.assertIn("1815 rpm, 150 %", page.text("#version_limits"))  # a limit of one point says of which
        self.look(f"{language}_approve")
        page.tab_to("version_go")
        self.assertIn("enzo", page.text("#version_go"))  # it says in whose name
        page.type(Keys.ENTER)
        page.wait("approved", lambda: page.text("#limits tbody td:nth-child(2)") == say["limits.approved"])
        page.tab_to(say["limits.activate"])
        page.type(Keys.ENTER)
        page.wait("the effect again", lambda: "7" in page.text("#version_effect"))
        page.tab_to("version_go")
        page.type(Keys.ENTER)
        page.wait("one version in force", lambda: say["limits.replaced"] in page.text("#limits tbody tr:last-child"))
        self.assertEqual(say["limits.activated"], page.text("#limits tbody tr:first-child td:nth-child(2)"))
        self.assertIn("enzo", page.text("#limits tbody tr:first-child"))
        self.look(f"{language}_limits")

    def test_in_english(self):
        self.go("en")

    def test_in_chinese(self):
        self.go("zh")

    def test_in_japanese(self):
        self.go("ja")


class Refusals(PageTest):
    """Each in the reader's language; what is only there in English stands beneath it, and says so."""
    run_s = 1

    def detail(self, element):
        return self.browser.text(f"{element} .detail:lang(en)")

    def go(self, language):
        page = self.browser
        self.enter("operator-token", language)
        say = self.words
        for text, key in (("B7", "error.serial_rule"), ("A30", "error.check_digit")):
            self.scan(text)
            page.wait(key, lambda t=text, k=key: page.text("#scan_fault") == say[k].replace("{text}", t))
        self.start("A29", say)
        page.wait_word(say["state.ERROR"])
        self.assertTrue(page.text("#reason").startswith(say["reason.device_lost"]))
        self.assertIn("no reply within 100 ms", self.detail("#reason"))
        self.look(f"{language}_bench_error")
        page.script("document.querySelector('#trend_filter [name=indicator]').value = 'none'")
        page.tab_to("tab_station")
        page.type(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        page.wait("a refusal", lambda: page.text("#trend_told").startswith(say["error.refused"]))
        self.assertEqual("trend: no indicator none", self.detail("#trend_told"))
        self.look(f"{language}_refused")
        page.tab_to("logout")
        page.type(Keys.ENTER)
        page.wait_word(say["state.login"])
        page.type("wrong-token", Keys.ENTER)
        page.wait("an unknown token", lambda: page.text("#login_fault") == say["error.bad_token"])

    def test_in_chinese(self):
        self.go("zh")

    def test_in_japanese(self):
        self.go("ja")


class Scanning(PageTest):
    def setUp(self):
        super().setUp()
        self.enter("operator-token")
        self.browser.wait_word("SCAN A UNIT")

    def test_what_is_no_serial_is_refused_in_words(self):
        for text, reason in (("B7", "no serial number"), ("A30", "check digit"), ("<i>x</i>", "“<i>x</i>”")):
            self.scan(text)
            self.browser.wait(reason, lambda r=reason: r in self.browser.text("#scan_fault"))
            self.assertEqual("SCAN A UNIT", self.browser.text("#state_word"))
        self.look("refused")
        self.scan("A31")
        self.browser.wait_word("READY")
        self.assertEqual("", self.browser.text("#scan_fault"))  # the silence

    def test_a_scan_lands_in_its_field_wherever_the_focus_was(self):
        page = self.browser
        page.tab_to("language")
        page.tab_to("tab_station")
        page.type(Keys.ARROW_RIGHT)
        page.wait("the history", lambda: page.text("#history tbody"))
        self.scan("A33")
        page.wait_word("READY")
        self.assertEqual("A33", page.text("#serial"))
        self.assertEqual("scan_text", page.focused())
        page.tab_to("logout")
        self.scan("A45")
        page.wait("the next unit", lambda: page.text("#serial") == "A45")

    def test_a_unit_tested_before_asks_first_and_escape_is_safe(self):
        page = self.browser
        self.scan("A16")
        page.wait("the safe answer has the focus", lambda: page.focused() == "another")
        self.assertIn("PASS", page.text("#known_runs"))
        self.look("duplicate")
        page.type(Keys.ESCAPE)
        page.wait_word("SCAN A UNIT")
        self.scan("A16")
        page.wait("the dialogue again", lambda: page.focused() == "another")
        self.scan("A35")  # the next unit scanned meanwhile: nothing was decided of the first
        page.wait_word("READY")
        self.assertEqual("A35", page.text("#serial"))
        self.scan("A16")
        page.wait("the dialogue a third time", lambda: page.focused() == "another")
        page.tab_to("retest", most=1)
        page.type(Keys.ENTER)
        page.wait_word("MEASURING")
        page.tab_to("stop")
        page.type(Keys.ENTER)
        page.wait_word("ABORTED")
        self.look("aborted")

    def test_a_bench_fault_is_not_told_as_the_units(self):
        page = self.browser
        self.start("A19")
        page.wait_word("BENCH ERROR")
        self.assertIn("not the unit", page.text("#next_action"))
        self.look("bench_error")
        self.scan("A37")
        page.wait_word("READY")

    def test_whoever_only_watches_can_start_nothing(self):
        page = self.browser
        self.scan("A39")
        page.wait_word("READY")
        self.enter_as_viewer()
        page.wait_word("WATCHING")
        self.assertTrue(page.script("return document.getElementById('start').disabled"))
        self.look("watching")

    def enter_as_viewer(self):
        page = self.browser
        page.tab_to("logout")
        page.type(Keys.ENTER)
        page.wait_word("LOG IN")
        page.type("wrong", Keys.ENTER)
        page.wait("a refusal", lambda: "not known" in page.text("#login_fault"))
        self.look("bad_token")
        page.type("viewer-token", Keys.ENTER)

    def test_the_language_chosen_is_kept(self):
        page = self.browser
        page.tab_to("language")
        page.type("日")
        page.wait("Japanese", lambda: page.text("#state_word") == words_of("ja")["state.idle"])
        page.open(self.station.url)
        page.wait("Japanese still", lambda: page.text("#state_word") == words_of("ja")["state.idle"])


class Watching(PageTest):
    run_s = 12  # long enough to go through the page meanwhile

    def test_a_history_that_is_looked_at_takes_the_run_in_that_ends(self):
        page = self.browser
        self.enter("operator-token")
        page.wait_word("SCAN A UNIT")
        self.start("A47")
        page.wait_word("MEASURING")
        page.tab_to("tab_station")
        page.type(Keys.ARROW_RIGHT)
        page.wait("the history", lambda: page.text("#history tbody"))
        self.assertNotIn("A47", page.text("#history"))
        page.wait("the new run", lambda: "A47" in page.text("#history"), 2 * self.run_s)


class Loss(PageTest):
    def test_a_backend_killed_in_mid_run_is_told_within_2_s_and_found_again(self):
        page = self.browser
        self.enter("operator-token")
        self.start("A41")
        page.wait_word("MEASURING")
        page.script("window.was_here = true")
        self.station.kill()
        page.wait_word("NOT CONNECTED", 2.0)
        self.look("not_connected")
        self.station.start()
        page.wait_word("LOG IN")  # the new one knows nobody yet
        page.type("operator-token", Keys.ENTER)
        page.wait_word("PASS")
        self.look("pass")
        self.assertTrue(page.script("return window.was_here"))  # no refresh

    def test_a_backend_that_hangs_is_told_within_2_s_and_comes_back_by_itself(self):
        page = self.browser
        self.enter("operator-token")
        page.wait("a state", lambda: page.text("#state_word") not in ("LOG IN", "NOT CONNECTED"))
        word = page.text("#state_word")
        self.station.hang()
        begun_s = time.monotonic()
        page.wait_word("NOT CONNECTED", 3)
        self.assertLess(time.monotonic() - begun_s, 2.2)  # 2 s, and how long asking takes
        self.station.go_on()
        page.wait_word(word)


class PlainPlots(PageTest):
    """A program built without npm has its own plots."""

    plots = False

    def test_curves_without_uplot(self):
        page = self.browser
        self.enter("operator-token")
        self.start("A43")
        page.wait("a curve", lambda: page.script(
            "return document.querySelector('#strip_speed .curve')?.getAttribute('d').length ?? 0") > 60)
        page.wait("a spectrum", lambda: page.script(
            "return document.querySelector('#spectrum .curve')?.getAttribute('d').length ?? 0") > 1000)
        self.look("plain_plots")


class AgainstReal(unittest.TestCase):
    """The same way with the real program: a simulated bench, plan quick."""

    def setUp(self):
        self.station = RealStation(OPTIONS)
        self.addCleanup(self.station.close)
        self.browser = Browser(OPTIONS.shots)
        self.addCleanup(self.browser.close)
        self.words = words_of("en")

    def test_two_units_of_one_station(self):
        self.enter()
        self.run_a_unit_that_passes()
        self.see_report_and_history()
        self.put_strict_limits_in_force()
        self.rejudge_by_them()
        self.lose_the_backend_during_a_unit_that_fails()
        self.see_other_languages()
        self.assertEqual([], self.browser.complaints([*NOT_LOGGED_IN, ("/api/scan", 422)]))

    def enter(self):
        page = self.browser
        page.open(self.station.url)
        page.script("localStorage.setItem('rvbench_language', 'en')")
        page.open(self.station.url)
        page.wait_word("LOG IN")
        page.type(self.station.token, Keys.ENTER)
        page.wait_word("SCAN A UNIT")
        self.look("real_idle")

    def look(self, name):
        self.browser.shoot(name)
        self.assertEqual([], self.browser.overflows(), name)
        self.assertFalse(self.browser.scrolls(), name)

    def start(self, serial):
        page = self.browser
        page.type(serial, Keys.ENTER)
        page.wait_word("READY")
        self.assertEqual(serial, page.text("#serial"))
        page.tab_to("start", most=1)
        page.type(Keys.ENTER)
        page.wait_word("MEASURING")
        page.wait("a curve", lambda: page.text("#strip_torque output") != "–", 60)

    def run_a_unit_that_passes(self):
        page = self.browser
        self.start("A17")
        self.look("real_running")
        page.wait_word("PASS", 60)
        self.assertEqual(4, page.script("return document.querySelectorAll('#matrix [data-status=done]').length"))
        self.look("real_pass")

    def see_report_and_history(self):
        page = self.browser
        page.tab_to("report")
        page.type(Keys.ENTER)
        page.wait("the report", lambda: len(page.driver.window_handles) == 2)
        url, title = page.new_tab_url()
        self.assertIn("/api/runs/A17/", url)
        self.assertIn("A17", title)
        page.tab_to("tab_station")
        page.type(Keys.ARROW_RIGHT)
        page.wait("the run in the history", lambda: "A17" in page.text("#history tbody"))
        self.look("real_history")

    def put_strict_limits_in_force(self):
        """Limits that no unit keeps to, proposed by the command line."""
        page = self.browser
        self.station.propose_strict_limits()
        page.tab_to("tab_history")
        page.type(Keys.ARROW_RIGHT, Keys.ARROW_RIGHT)
        page.wait("the draft", lambda: "draft" in page.text("#limits tbody"))
        for button, done in (("limits.approve", "limits.approved"), ("limits.activate", "limits.activated")):
            page.tab_to(self.words[button])
            page.type(Keys.ENTER)
            page.wait("the effect", lambda: "Of 1 runs, 1 would fail" in page.text("#version_effect"))
            self.assertIn("A17/", page.text("#version_changes"))
            self.look(f"real_{done}")
            page.tab_to("version_go")
            page.type(Keys.ENTER)
            page.wait(done, lambda d=done: page.text("#limits tbody td:nth-child(2)") == self.words[d])
        self.assertIn("enzo", page.text("#limits tbody"))

    def rejudge_by_them(self):
        page = self.browser
        page.tab_to("tab_limits")
        page.type(Keys.ARROW_LEFT, Keys.ARROW_LEFT)
        page.wait("the history", lambda: "A17" in page.text("#history tbody"))
        page.tab_to(self.words["history.rejudge"])
        page.type(Keys.ENTER)
        page.wait("the version to choose", lambda: page.focused() == "rejudge_limits" and
                  "strict" in page.text("#rejudge_limits"))
        page.type(Keys.ARROW_DOWN)
        page.tab_to("rejudge_go")
        page.type(Keys.ENTER)
        page.wait("both judgements", lambda: page.text("#rejudge_told") ==
                  "As judged then: PASS. Re-judged: FAIL.", 60)
        self.look("real_rejudged")
        page.type(Keys.ESCAPE)
        page.wait("both in the history", lambda: "re-judged" in page.text("#history tbody tr:first-child"))

    def lose_the_backend_during_a_unit_that_fails(self):
        page = self.browser
        self.start("A18")
        page.script("window.was_here = true")
        self.station.kill()
        page.wait_word("NOT CONNECTED", 2.0)
        self.look("real_not_connected")
        self.station.start()
        page.wait_word("LOG IN")  # the new one knows nobody yet
        page.type(self.station.token, Keys.ENTER)
        page.wait_word("MEASURING")  # the run went on
        self.assertEqual("A18", page.text("#serial"))
        page.wait_word("FAIL", 60)
        self.assertIn("acceleration_peak", page.text("#reason"))
        self.assertTrue(page.script("return window.was_here"))  # no refresh
        self.look("real_fail")

    def see_other_languages(self):
        page, say = self.browser, self.reload_in("zh")
        page.wait_word(say["state.FAIL"])
        self.look("real_zh_fail")
        page.tab_to("next")
        page.type(Keys.ENTER)
        page.wait_word(say["state.idle"])
        self.see_duplicate(say, "zh")
        page.type("A19", Keys.ENTER)
        page.wait_word(say["state.ready"])
        self.look("real_zh_ready")
        say = self.reload_in("ja")
        page.wait_word(say["state.ready"])
        self.look("real_ja_ready")
        self.see_duplicate(say, "ja")

    def reload_in(self, language):
        self.browser.script("localStorage.setItem('rvbench_language', arguments[0])", language)
        self.browser.open(self.station.url)
        return words_of(language)

    def see_duplicate(self, say, language):
        page = self.browser
        page.type("B1", Keys.ENTER)
        page.wait("the refusal", lambda: page.text("#scan_fault") == say["error.serial_rule"].replace("{text}", "B1"))
        page.type("A18", Keys.ENTER)
        page.wait("the safe answer has the focus", lambda: page.focused() == "another")
        self.look(f"real_{language}_duplicate")
        page.type(Keys.ESCAPE)
        page.wait_word(say["state.idle"])
        self.look(f"real_{language}_idle")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--page", type=pathlib.Path, required=True)
    parser.add_argument("--plots", type=pathlib.Path)
    parser.add_argument("--shots", type=pathlib.Path)
    parser.add_argument("--against", choices=("fake", "real"), default="fake")
    parser.add_argument("--program", type=pathlib.Path)
    _, rest = parser.parse_known_args(namespace=OPTIONS)
    with_fake = [Words, Source, WholeWay, Refusals, Scanning, Watching, Loss, PlainPlots]
    every = [AgainstReal] if OPTIONS.against == "real" else with_fake
    names = [name for name in rest if not name.startswith("-")] or [c.__name__ for c in every]
    unittest.main(argv=sys.argv[:1] + [r for r in rest if r.startswith("-")] + names)


if __name__ == "__main__":
    main()
