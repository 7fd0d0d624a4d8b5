#!/usr/bin/env python3
"""The page goes on while an answer is on its way."""
from browser import Keys
from page_case import PageTest, run
from stations import OtherPage


class LateAnswers(PageTest):
    """The page goes on while an answer is on its way: it is not told of what it was not asked for."""

    hold = """
      const [part] = arguments, ask = window.fetch;
      window.held = [];
      window.taken = 0;
      window.fetch = async (path, how) => {
        const answer = await ask(path, how);
        if (!path.includes(part)) return answer;
        await new Promise((go) => window.held.push(go));
        const read = answer.json.bind(answer);
        answer.json = () => read().finally(() => ++window.taken);
        return answer;
      };"""

    def setUp(self):
        super().setUp()
        self.enter()
        self.browser.wait_word("SCAN A UNIT")

    def wait_held(self, number):
        self.browser.wait(f"answer {number}", lambda: self.browser.script("return window.held.length") == number)

    def let_go(self, number):
        """Returns when the page has it."""
        page = self.browser
        taken = page.script("return window.taken")
        page.script("window.held[arguments[0] - 1]()", number)
        page.wait("that it is taken", lambda: page.script("return window.taken") == taken + 1)

    def open_rejudge(self, serial):
        page = self.browser
        page.script("[...document.querySelectorAll('#history tr')].find((row) => row.innerText.includes(arguments[0]))"
                    ".querySelector('button').focus()", serial)
        page.type(Keys.ENTER)
        page.wait("the dialogue", lambda: page.focused() == "rejudge_limits")

    def judge_again(self, serial):
        page = self.browser
        self.open_rejudge(serial)
        self.browser.wait_enabled("rejudge_go")
        page.tab_to("rejudge_go")
        page.type(Keys.ENTER)

    def test_a_judgement_is_told_under_its_own_unit(self):
        page = self.browser
        self.go_to("history")
        page.script(self.hold, "rejudge")
        self.judge_again("A14")
        self.wait_held(1)
        self.assertTrue(self.browser.is_disabled("rejudge_go"))
        page.type(Keys.ESCAPE)
        self.open_rejudge("A12")
        self.browser.wait_enabled("rejudge_go")
        self.let_go(1)
        page.wait("the judgement in the history", lambda: "re-judged" in page.text("#history"))
        self.assertEqual("Re-judge A12", page.text("#rejudge_title"))
        self.assertEqual("", page.text("#rejudge_told"))
        page.type(Keys.ESCAPE)

        self.judge_again("A12")
        self.wait_held(2)
        page.type(Keys.ESCAPE)
        self.open_rejudge("A12")  # it is waited for still
        self.assertEqual("One moment …", page.text("#rejudge_told"))
        self.assertTrue(self.browser.is_disabled("rejudge_go"))
        self.let_go(2)
        page.wait("both judgements", lambda: page.text("#rejudge_told") == "As judged then: PASS. Re-judged: FAIL.")
        self.browser.wait_enabled("rejudge_go")

    def test_nothing_is_judged_again_before_the_limits_are_listed(self):
        self.go_to("history")
        self.browser.script(self.hold, "/api/limits")
        self.open_rejudge("A12")
        self.wait_held(1)
        self.assertTrue(self.browser.is_disabled("rejudge_go"))
        self.let_go(1)
        self.browser.wait_enabled("rejudge_go")

    def test_an_approval_closes_no_other_version(self):
        page = self.browser
        other = OtherPage(self.station.url, "engineer-token")
        drafts = [other.act("limits/propose")["limits_version"] for _ in range(2)]
        self.go_to("limits")
        page.script(self.hold, "limits/approve")
        page.tab_to("Review")
        page.type(Keys.ENTER)
        page.tab_to("version_go")
        page.wait("the effect", lambda: "7" in page.text("#version_effect"))
        page.tab_to("version_go")
        page.type(Keys.ENTER)
        self.wait_held(1)
        self.assertTrue(self.browser.is_disabled("version_go"))
        page.type(Keys.ESCAPE)
        page.script("document.querySelector('#limits tbody tr:nth-child(2) button').focus()")
        page.type(Keys.ENTER)
        page.wait("the other version", lambda: page.text("#version_title") == f"Limits, version {drafts[0]}")
        self.let_go(1)
        page.wait("approved", lambda: "approved" in page.text("#limits tbody tr:first-child"))
        self.assertEqual(f"Limits, version {drafts[0]}", page.text("dialog[open] h2"))
        page.wait_enabled("version_go")  # its own effect may still be on its way

    def test_the_newest_question_is_answered(self):
        page = self.browser
        page.script(self.hold, "/api/history")
        page.script("document.getElementById('tab_station').focus()")
        page.type(Keys.ARROW_RIGHT)
        self.wait_held(1)
        page.tab_to("serial")
        page.type("A12", Keys.ENTER)
        self.wait_held(2)
        self.let_go(2)
        page.wait("the unit", lambda: "A12" in page.text("#history tbody"))
        self.let_go(1)
        self.assertEqual(1, page.script("return document.querySelectorAll('#history tbody tr').length"))
        self.assertIn("The newest 1 runs", page.text("#history_told"))

    def test_who_asks_for_no_indicator_is_told_nothing_of_the_one_before(self):
        page = self.browser
        self.go_to("trend")
        page.wait("a sentence", lambda: page.text("#trend_told"))
        page.tab_to("indicator")
        page.script("document.querySelector('#trend_filter [name=indicator]').value = ''")
        page.type(Keys.ENTER)
        page.wait("nothing told", lambda: not page.text("#trend_told"))
        self.assertEqual("", page.text("#trend tbody"))

    def test_a_refusal_leaves_nothing_of_the_question_before(self):
        page = self.browser
        self.go_to("trend")
        self.assertEqual(0, page.script("return document.querySelectorAll('#trend_plot .nothing').length"))
        page.tab_to("indicator")
        page.type("none", Keys.ENTER)
        page.wait("a refusal", lambda: "trend: no indicator none" in page.text("#trend_told"))
        self.assertEqual("", page.text("#trend tbody"))
        self.assertEqual(1, page.script("return document.querySelectorAll('#trend_plot .nothing').length"))


if __name__ == "__main__":
    run()
