#!/usr/bin/env python3
"""A station that is killed, and one that hangs: told within 2 s of real time."""
import time

from browser import Keys
from page_case import PageTest, run


class Loss(PageTest):
    def test_a_backend_killed_in_mid_run_is_told_within_2_s_and_found_again(self):
        page = self.browser
        self.enter("operator-token")
        self.start("A41")
        page.wait_word("MEASURING")
        self.lose_and_find_the_backend("operator-token", "not_connected")
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


class LossInMidRun(PageTest):
    run_s = 60

    def test_a_test_is_stopped_from_a_page_that_hears_nothing(self):
        page = self.browser
        self.enter("operator-token")
        self.start("A41")
        page.wait_word("MEASURING")
        self.station.hang()
        page.wait_word("NOT CONNECTED", 3)
        page.tab_to("stop")
        page.type(Keys.ENTER)
        self.station.go_on()
        page.wait_word("ABORTED")


if __name__ == "__main__":
    run()
