#include <catch2/catch.hpp>
#include <deque>
#include <fstream>
#include <regex>
#include <string>

#include "tests/packaging/guide.hpp"
#include "tests/packaging/installed.hpp"

// The guides' commands, typed as they stand there, with what was installed in place of /usr.

namespace rvbench {
namespace {

using test::Answer;
using test::bash;
using test::guide_lines;
using test::GuideLine;
using test::Installed;
using test::Kind;
using test::Program;
using test::ScratchFolder;

// @return how many commands were run
int follow(const std::string& name) {
  const Installed installed;
  const ScratchFolder desk;
  const std::string usr = (installed / "").string();
  std::deque<Program> beside;
  int run = 0;
  for (const GuideLine& line : guide_lines(installed.text_of("share/doc/rvbench/guide/" + name))) {
    INFO(name << ": " << line.command);
    CHECK(test::unknown_words(line.command) == "");
    if (line.kind == Kind::by_hand) continue;
    const std::string path = "export PATH=" + usr + "bin:$PATH; ";
    const std::string command = std::regex_replace(line.command, std::regex("/usr/"), usr);
    ++run;
    if (line.kind == Kind::beside) {
      const std::vector<std::string> words{"/bin/bash", "-c", path + "exec " + command};
      REQUIRE(beside.emplace_back(desk.path(), words).says("serving"));
      continue;
    }
    const Answer answer = bash(desk.path(), path + command);
    INFO(answer.out << answer.err);
    REQUIRE(answer.code == line.code);
  }
  return run;
}

}  // namespace

TEST_CASE("the guide to the first PASS is true", "[packaging]") {
  CHECK(follow("first_pass.md") >= 6);
}

TEST_CASE("the guide from simulation to a bench is true", "[packaging]") {
  CHECK(follow("your_bench.md") >= 6);
}

TEST_CASE("the guide to a machine of one's own is true", "[packaging]") {
  CHECK(follow("your_machine.md") >= 2);
  const Installed installed;
  const ScratchFolder desk;
  const std::string text = installed.text_of("share/doc/rvbench/guide/your_machine.md");
  const std::regex block("```json\n([^`]*)```");
  int machines = 0;
  for (std::sregex_iterator found(text.begin(), text.end(), block), end; found != end; ++found) {
    std::ofstream(desk / "machine.json") << found->str(1);
    const std::string rvbench = (installed / "bin/rvbench").string();
    const Answer answer = bash(desk.path(), rvbench + " check machine.json");
    INFO(found->str(1) << answer.err);
    CHECK(answer.code == 0);
    ++machines;
  }
  CHECK(machines == 3);
}

TEST_CASE("a guide's blocks are read as they are meant", "[packaging]") {
  const auto lines = guide_lines(
      "text\n```sh\nrvbench run \\\n  quick   # exit code 10\n\n```\n```sh by-hand\nls\n```\n"
      "```\nan answer\n```\n");
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].command == "rvbench run   quick");
  CHECK(lines[0].code == 10);
  CHECK(lines[1].kind == Kind::by_hand);
  CHECK_THROWS(guide_lines("```sh\nls\n"));
  CHECK_THROWS(guide_lines("```sh by-foot\nls\n```\n"));
  CHECK(guide_lines("no block").empty());
  CHECK(test::unknown_words("rvbench run quick --rig sim --fast") == "--fast ");
  CHECK(test::unknown_words("rvbench fly") == "fly");
  CHECK(test::unknown_words("ls --fast") == "");
}

}  // namespace rvbench
