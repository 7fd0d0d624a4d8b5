#include "bench/progress_bar.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/support/terminal.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;

TEST_CASE("a progress line fits the terminal, however small", "[bench]") {
  for (int columns = 5; columns < 200; ++columns) {
    const std::string line =
        progress_line("measure", 0.52, 67, "record 605 rpm, 50 %, N·m", columns);
    INFO(columns << ": " << line);
    CHECK(shown_width(line) <= columns);
    CHECK_THAT(line, Contains("52 %"));
  }
}

TEST_CASE("a wide terminal shows bar, percentage, time left and what is done", "[bench]") {
  CHECK(progress_line("measure", 0.5, 67.2, "record 605 rpm", 80) ==
        "measure [###############...............]  50 %  1:08 left  record 605 rpm");
  CHECK_THAT(progress_line("measure", 0.5, 3700, "", 80), Contains("1:01:40 left"));
  CHECK_THAT(progress_line("measure", 0.0, std::nan(""), "", 80), !Contains("left"));
}

TEST_CASE("the bar does not change its width when the time left becomes known", "[bench]") {
  for (int columns = 40; columns < 120; ++columns) {
    const std::string unknown = progress_line("measure", 0.5, std::nan(""), "record", columns);
    const std::string known = progress_line("measure", 0.5, 3700, "record", columns);
    INFO(columns);
    CHECK(unknown.find(']') == known.find(']'));
  }
}

TEST_CASE("a bar hides the cursor and gives it back", "[bench]") {
  std::ostringstream out;
  std::ostringstream err;
  Console console{out, err, false, true};
  double now_s = 0;
  {
    ProgressBar bar(console, progress_style(console, false), [&] { return now_s; });
    bar.show("measure", 0.1, "warm up");
    now_s = 10;
    bar.show("measure", 0.5, "record");
  }
  const std::string text = err.str();
  CHECK_THAT(text, Contains("0:10 left"));
  CHECK(text.find("\x1b[?25l") != std::string::npos);
  CHECK(text.rfind("\x1b[?25h") > text.rfind("\x1b[?25l"));
  CHECK(out.str().empty());
}

TEST_CASE("a terminal that has been stopped keeps nobody waiting", "[bench][safety]") {
  const rvbench::test::Terminal terminal;
  std::ofstream err(terminal.name());
  Console console{err, err, false, true};
  console.err_descriptor = terminal.descriptor();
  double now_s = 0;
  {
    ProgressBar bar(console, ProgressBar::Style::bar, [&] { return ++now_s; });
    terminal.stop();
    bar.show("measure", 0.1, "unseen");
    terminal.go_on();
    bar.show("measure", 0.2, "seen");
    terminal.stop();
  }
  CHECK(err.good());
  CHECK_THAT(terminal.shown(), Contains("20 %") && !Contains("10 %"));
}

TEST_CASE("off a terminal a job of 1000 steps writes eleven plain lines", "[bench]") {
  std::ostringstream out;
  std::ostringstream err;
  Console console{out, err};
  ProgressBar bar(console, progress_style(console, false));
  for (int i = 0; i <= 1000; ++i) bar.show("judge", i / 1000.0, "point");
  const std::string text = err.str();
  CHECK(std::count(text.begin(), text.end(), '\n') == 11);
  CHECK(text.find('\x1b') == std::string::npos);
}

TEST_CASE("with --json there is no progress at all", "[bench]") {
  std::ostringstream out;
  std::ostringstream err;
  Console console{out, err, true, true};
  ProgressBar bar(console, progress_style(console, true));
  bar.show("judge", 0.5, "point");
  CHECK(err.str().empty());
}

TEST_CASE("colour appears only where the console has it", "[bench]") {
  std::ostringstream stream;
  CHECK(paint(Console{stream, stream}, Tone::bad, "FAIL") == "FAIL");
  CHECK(paint(Console{stream, stream, true}, Tone::bad, "FAIL") == "\x1b[1;31mFAIL\x1b[0m");
}

}  // namespace rvbench::bench
