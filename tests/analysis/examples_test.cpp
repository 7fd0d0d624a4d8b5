#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "bench/examples/page.hpp"
#include "tests/support/program.hpp"
#include "tests/support/this_build.hpp"

using namespace rvbench;
using test::Answer;
using test::Program;
using test::ScratchFolder;

namespace {

const std::filesystem::path committed = test::source_dir() / "analysis/examples";

// Of the files with that extension: name and text.
std::map<std::string, std::string> files_of(const std::filesystem::path& folder,
                                            const std::string& extension) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != extension) continue;
    std::ifstream file(entry.path());
    files[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

// A text with each number taken out, and the numbers.
struct Taken {
  std::string rest;
  std::vector<double> numbers;
};

Taken numbers_taken_from(const std::string& text) {
  Taken taken;
  const char* at = text.c_str();
  while (*at != '\0') {
    const bool begins = *at >= '0' && *at <= '9';
    if (!begins) {
      taken.rest += *at++;
      continue;
    }
    char* end = nullptr;
    taken.numbers.push_back(std::strtod(at, &end));
    taken.rest += '#';
    at = end;
  }
  return taken;
}

double most_apart(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

struct Written {
  ScratchFolder folder;
  Answer answer =
      Program(folder.path(), {test::build_dir() / "rvbench_examples", folder.path()}).wait();
};

}  // namespace

SCENARIO("the pages of the examples are what the examples say", "[analysis][examples]") {
  GIVEN("what the program writes now") {
    const Written now;
    REQUIRE(now.answer.code == 0);
    THEN("every committed page has the same lines and the same figures") {
      const auto written = files_of(now.folder.path(), ".md");
      const auto kept = files_of(committed, ".md");
      CHECK(written.size() == 18);  // an example each, and the page that leads to them
      REQUIRE(kept.size() == written.size());
      for (const auto& [name, text] : written) {
        CAPTURE(name);
        REQUIRE(kept.contains(name));
        CHECK(kept.at(name) == text);
      }
    }
    THEN("every committed plot is the same to a fifth of a pixel") {
      // Processors differ in the last digit of a transform, which may move a point by a tenth.
      const auto written = files_of(now.folder.path(), ".svg");
      const auto kept = files_of(committed, ".svg");
      REQUIRE(kept.size() == written.size());
      for (const auto& [name, text] : written) {
        CAPTURE(name);
        REQUIRE(kept.contains(name));
        const Taken is = numbers_taken_from(text), was = numbers_taken_from(kept.at(name));
        CHECK(is.rest == was.rest);
        REQUIRE(is.numbers.size() == was.numbers.size());
        CHECK(most_apart(is.numbers, was.numbers) < 0.2);
      }
    }
    THEN("a plot is small, and holds nothing that is no number") {
      for (const auto& [name, text] : files_of(now.folder.path(), ".svg")) {
        CAPTURE(name);
        CHECK(text.size() < 60000);
        CHECK(text.find("nan") == std::string::npos);
        CHECK(text.find("inf") == std::string::npos);
      }
    }
  }
}

TEST_CASE("without a folder the program says what it wants", "[analysis][examples]") {
  const ScratchFolder folder;
  CHECK(Program(folder.path(), {test::build_dir() / "rvbench_examples"}).wait().code == 2);
  CHECK(Program(folder.path(), {test::build_dir() / "rvbench_examples", folder / "none"})
            .wait()
            .code == 1);
}

TEST_CASE("a page shows the marked lines of its source", "[analysis][examples]") {
  const std::string source =
      "void f() {\n  //! [page]\n  a();\n    b();\n\n  c();\n  //! [page]\n  d();\n"
      "  //! [page]\n    e();\n  //! [page]\n}\n";
  CHECK(bench::shown_lines(source) == "a();\n  b();\n\nc();\n\ne();\n");
  CHECK(bench::shown_lines("void f() {}\n").empty());
}
