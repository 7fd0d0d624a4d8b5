#!/usr/bin/env python3
"""The operator page from end to end, in each of its languages."""
import re

from browser import Keys
from page_case import PageTest, refused_to_nobody, run


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
        self.assertEqual([], page.complaints(refused_to_nobody()))

    def see_history(self, language):
        page, say = self.browser, self.words
        page.tab_to("tab_station")
        page.type(Keys.ARROW_RIGHT)
        page.wait("the run that ended", lambda: "A27" in page.text("#history tbody tr:first-child"))
        self.look(f"{language}_history")
        page.tab_to(say["history.rejudge"])
        page.type(Keys.ENTER)
        page.wait("the dialogue", lambda: page.focused() == "rejudge_limits")
        page.wait_enabled("rejudge_go")
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
        self.assertTrue(page.text("#trend_told").startswith(self.words["trend.untold"]))
        self.assertEqual("no trend can be told: 8 runs, 10 are needed", page.text("#trend_told .detail:lang(en)"))
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
        self.assertIn("gone.json is missing", page.text("#limits .detail:lang(en)"))
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
    run_s = 4

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
        page.wait_word(say["state.running"])
        page.wait("the stage", lambda: page.text("#stage").startswith(say["stage.measure"]))
        self.assertIn("rpm", self.detail("#stage"))
        self.look(f"{language}_stage")
        page.wait_word(say["state.ERROR"])
        self.assertTrue(page.text("#reason").startswith(say["reason.device_lost"]))
        self.assertIn("no reply within 100 ms", self.detail("#reason"))
        self.look(f"{language}_bench_error")
        self.go_to("history")
        self.assertIn(say["reason.device_lost"], page.text("#history tbody tr:first-child"))
        self.assertIn("no reply within 100 ms", self.detail("#history tbody tr:first-child"))
        self.assertEqual("input_shaft: misalignment", page.script(
            "return [...document.querySelectorAll('#history [lang=en]')].at(-1).innerText"))
        self.look(f"{language}_reasons")
        page.script("document.querySelector('#trend_filter [name=indicator]').value = 'none'")
        page.tab_to("tab_history")
        page.type(Keys.ARROW_RIGHT)
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


if __name__ == "__main__":
    run()
