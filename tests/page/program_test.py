#!/usr/bin/env python3
"""The whole way with the real program."""
from browser import Browser, Keys
from page_case import OPTIONS, BrowserTest, refused_to_nobody, run, words_of
from stations import RealStation


class AgainstReal(BrowserTest):
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
        self.assertEqual([], self.browser.complaints([*refused_to_nobody(), ("/api/scan", 422)]))

    def enter(self):
        page = self.browser
        page.open(self.station.url)
        page.script("localStorage.setItem('rvbench_language', 'en')")
        page.open(self.station.url)
        page.wait_word("LOG IN")
        page.type(self.station.token, Keys.ENTER)
        page.wait_word("SCAN A UNIT")
        self.look("real_idle")

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
        self.lose_and_find_the_backend(self.station.token, "real_not_connected")
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


if __name__ == "__main__":
    run()
