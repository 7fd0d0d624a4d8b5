#!/usr/bin/env python3
"""What the page says, in each of its languages, and what its source may not do."""
import re
import unittest

from page_case import OPTIONS, run, words_of

# Words of refusals that the page never meets, for it asks in due form.
FOR_PROGRAMS = {"host", "origin", "method", "malformed", "bad_request", "target_too_long", "ranges", "header_twice",
                "length_required", "content_length", "body_too_large", "expected_json"}


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
        stages = set(re.findall(r'\.stage = "(\w+)"', "".join(text.values())))
        reasons = set(re.findall(r'\bfail\("(\w+)"', "".join(text.values())))
        self.assertGreater(len(asked), 15)  # the patterns above still find them
        self.assertGreater(len(reasons), 3)
        self.assertTrue(stages)
        keys = {f"error.{word}" for word in asked} | {f"reason.{word}" for word in reasons}
        keys |= {f"stage.{word}" for word in stages}
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


if __name__ == "__main__":
    run()
