"""What the tests of the operator page share: a headless Chromium that goes by the keyboard alone.

    whole_way_test.py --page bench/serve/page [--plots FOLDER] [--shots FOLDER] [unittest's arguments]

A fake station answers, but for program_test.py, which takes --program rvbench.
"""
import argparse
import json
import pathlib
import sys
import unittest

from browser import Browser, Keys
from stations import FakeStation

OPTIONS = argparse.Namespace()


def refused_to_nobody():
    """What a browser is refused before anybody has logged in: uPlot as well, where npm had none."""
    has_plots = OPTIONS.plots and (OPTIONS.plots / "uplot.js").exists()
    return [("/favicon.ico", 404), ("/api/session", 401), *([] if has_plots else [("/uplot.js", 404)])]


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


class BrowserTest(unittest.TestCase):
    def look(self, name):
        """Nothing is cut or beyond the window of 1024 x 768, and the window does not scroll."""
        self.browser.shoot(name)
        self.assertEqual([], self.browser.overflows(), name)
        self.assertFalse(self.browser.scrolls(), name)

    def lose_and_find_the_backend(self, token, shot):
        """Killed, it is missed within 2 s; started anew, it is found again without a refresh."""
        page = self.browser
        page.script("window.was_here = true")
        self.station.kill()
        page.wait_word("NOT CONNECTED", 2.0)
        self.look(shot)
        self.station.start()
        page.wait_word("LOG IN")  # the new one knows nobody yet
        page.type(token, Keys.ENTER)


class PageTest(BrowserTest):
    """One browser for all, a station for each."""

    plots = True
    run_s = 3
    station_options = ()

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser(OPTIONS.shots)
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        self.station = FakeStation(OPTIONS, self.plots, self.run_s, *self.station_options)
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

    def go_to(self, view):
        """By the arrows, from wherever."""
        page = self.browser
        page.script("document.querySelector('#tabs [aria-selected=true]').focus()")
        names = ["station", "history", "trend", "limits"]
        now = page.script("return document.body.dataset.view")
        page.type(*[Keys.ARROW_RIGHT] * ((names.index(view) - names.index(now)) % len(names)))
        page.wait(f"the rows of {view}", lambda: page.text(f"#{view} tbody"))

    def scan(self, text):
        self.browser.type(text, Keys.ENTER)

    def start(self, serial, say=None):
        self.scan(serial)
        self.browser.wait_word(say["state.ready"] if say else "READY")
        self.browser.tab_to("start")
        self.browser.type(Keys.ENTER)


def run():
    """The tests of the file that is run."""
    parser = argparse.ArgumentParser(description=sys.modules["__main__"].__doc__)
    parser.add_argument("--page", type=pathlib.Path, required=True)
    parser.add_argument("--plots", type=pathlib.Path)
    parser.add_argument("--shots", type=pathlib.Path)
    parser.add_argument("--program", type=pathlib.Path)
    _, rest = parser.parse_known_args(namespace=OPTIONS)
    unittest.main(argv=sys.argv[:1] + rest)
