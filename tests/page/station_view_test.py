#!/usr/bin/env python3
"""What an operator meets at the station beside the straight way."""
import collections

from browser import Keys
from fake_station import POINTS_LOADS_FIRST
from page_case import PageTest, run, words_of
from stations import OtherPage


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
        self.go_to("history")
        page.tab_to("verdict")
        self.scan("A47")
        page.wait("the one after it", lambda: page.text("#serial") == "A47")

    def test_a_scan_chooses_no_language(self):
        page, say = self.browser, words_of("ja")
        page.tab_to("language")
        page.type(Keys.ARROW_UP)
        page.wait_word(say["state.idle"])
        self.assertEqual("language", page.focused())  # arrows may go on to the next
        self.scan("E123")
        page.wait("the refusal", lambda: page.text("#scan_fault") == say["error.serial_rule"].replace("{text}", "E123"))
        self.assertEqual(say["state.idle"], page.text("#state_word"))
        page.tab_to("logout")
        page.type(Keys.ENTER)
        page.wait_word(say["state.login"])
        page.script("document.getElementById('language').focus()")
        page.type(Keys.ARROW_DOWN)
        page.wait_word("LOG IN")
        self.assertEqual("token", page.focused())

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

    def test_the_question_is_about_the_unit_that_it_names(self):
        page = self.browser
        self.scan("A16")
        page.wait("the question", lambda: page.focused() == "another")
        page.tab_to("retest", most=1)
        OtherPage(self.station.url, "operator-token").act("scan", text="A12")
        page.wait("the other unit", lambda: "A12" in page.text("#duplicate_title"))
        self.assertEqual("another", page.focused())
        page.tab_to("retest", most=1)
        page.type(Keys.ENTER)
        page.wait_word("MEASURING")
        self.assertEqual("A12", page.text("#serial"))

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
        page.type(Keys.ARROW_UP)
        page.wait("Japanese", lambda: page.text("#state_word") == words_of("ja")["state.idle"])
        page.open(self.station.url)
        page.wait("Japanese still", lambda: page.text("#state_word") == words_of("ja")["state.idle"])


class Busy(PageTest):
    station_options = ("--busy-words", "3")

    def test_words_are_asked_for_until_they_come(self):
        page, say = self.browser, words_of("ja")
        self.enter("operator-token")  # no refresh but those that choose the language
        self.station.kill()
        page.wait_word("NOT CONNECTED")
        page.tab_to("language")
        page.type(Keys.ARROW_UP)
        self.station.start()  # as busy as it was
        page.wait_word(say["state.login"])


class EditedPlan(PageTest):
    def test_marks_stand_at_the_points_of_the_plan_that_is(self):
        page = self.browser
        self.enter("operator-token")
        self.start("A27")
        page.wait_word("FAIL")
        self.station.kill()
        self.station.command.append("--loads-first")
        self.station.start()
        page.wait_word("LOG IN")
        page.type("operator-token", Keys.ENTER)
        page.wait_word("FAIL")
        failed = collections.Counter((f"{speed} rpm", f"{load} %") for i, (speed, load, _) in
                                     enumerate(POINTS_LOADS_FIRST) if i % 11 == 5)
        shown = page.script("""
          const loads = [...document.querySelectorAll("#matrix thead th")].map((th) => th.innerText);
          return [...document.querySelectorAll("#matrix td [data-status=failed]")].map((mark) => {
            const td = mark.closest("td");
            return [td.parentElement.cells[0].innerText, loads[td.cellIndex]];
          });""")
        self.assertEqual(failed, collections.Counter(map(tuple, shown)))


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

    def test_the_limit_of_one_part_is_none_of_all(self):
        self.enter("operator-token")
        self.go_to("trend")
        page = self.browser
        page.wait("a limit", lambda: page.script("return document.querySelectorAll('#trend_plot .limit').length"))
        self.assertEqual(1, page.script("return document.querySelectorAll('#trend_plot .limit').length"))


if __name__ == "__main__":
    run()
