#!/usr/bin/env python3
"""The history: its days, what can be done with a run, and the run that ends meanwhile."""
from browser import Keys
from page_case import PageTest, run
from stations import OtherPage


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
        newest = "#history tbody tr:first-child"
        self.assertIn("still at work", page.text(f"{newest} .detail"))
        self.assertEqual("", page.text(f"{newest} .actions"))  # there is nothing to show or to judge yet
        page.wait("its verdict", lambda: "FAIL" in page.text(newest), 2 * self.run_s)
        self.assertIn("A47", page.text(newest))
        self.assertEqual("Report", page.text(f"{newest} .actions"))


class History(PageTest):
    def setUp(self):
        super().setUp()
        self.enter()
        self.browser.wait_word("SCAN A UNIT")

    def live_in(self, timezone):
        self.browser.driver.execute_cdp_cmd("Emulation.setTimezoneOverride", {"timezoneId": timezone})

    def days_of(self, day):
        """What stands in the table when it is narrowed to one day."""
        page = self.browser
        page.script("for (const e of document.querySelectorAll('#history_filter [type=date]')) e.value = arguments[0]", day)
        page.tab_to("tab_history")
        page.tab_to("serial")
        page.type(Keys.ENTER)
        page.wait("an answer", lambda: page.text("#history_told") not in ("", "One moment …"))
        return page.script("return [...document.querySelectorAll('#history tbody tr')]"
                           ".map((row) => row.cells[0].innerText + ' ' + row.querySelector('b').innerText)")

    def test_a_day_is_that_of_the_times_shown(self):
        self.addCleanup(self.live_in, "")
        for timezone, day, runs in (
                ("America/Los_Angeles", "2026-11-19", ["19 Nov 2026, 17:15 A10"]),
                ("America/Los_Angeles", "2026-11-25", ["25 Nov 2026, 23:15 A16"]),
                ("Pacific/Kiritimati", "2026-11-25", ["25 Nov 2026, 20:15 A15"]),
                ("Asia/Shanghai", "2026-11-27", [])):
            self.live_in(timezone)
            self.browser.open(self.station.url)
            self.browser.wait_word("SCAN A UNIT")
            self.go_to("history")
            self.assertEqual(runs, self.days_of(day), timezone)

    def test_what_has_no_verdict_can_be_neither_shown_nor_judged(self):
        page = self.browser
        self.go_to("history")
        row = "#history tbody tr:first-child"
        self.assertIn("A21", page.text(row))
        self.assertEqual("", page.text(f"{row} .actions"))
        self.assertIn("Re-judge", page.text("#history tbody tr:nth-child(2) .actions"))
        self.assertTrue(page.text(f"{row} td:nth-child(4)").startswith(self.words["history.no_verdict"]))

    def test_it_is_judged_again_by_limits_that_are_there(self):
        page = self.browser
        other = OtherPage(self.station.url, "engineer-token")
        for step in ("propose", "approve", "activate"):
            other.act(f"limits/{step}", version="4")
        self.go_to("history")
        page.tab_to("Re-judge")
        page.type(Keys.ENTER)
        page.wait("the versions", lambda: page.script("return document.getElementById('rejudge_limits').length > 1"))
        self.assertEqual(["as in the run's plan", "version 1 (replaced)", "version 4 (active)"], page.script(
            "return [...document.getElementById('rejudge_limits').options].map((option) => option.innerText)"))
        self.look("rejudge_limits")


if __name__ == "__main__":
    run()
