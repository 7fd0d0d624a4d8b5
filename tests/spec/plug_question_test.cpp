#include <signal.h>

#include <catch2/catch.hpp>

#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/terminal.hpp"

// Before `probe --pull-the-plug` lets the shaft turn it asks somebody at a terminal.

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;

std::vector<std::string> probe_reading_from(const std::string& input) {
  return {"/bin/sh", "-c", "exec \"$0\" probe --rig sim --pull-the-plug < " + input,
          test::rvbench_path()};
}

}  // namespace

TEST_CASE("a probe that can ask nobody turns no shaft, and says what to do", "[spec][safety]") {
  const test::ScratchFolder scratch;
  test::Program probe(scratch.path(), probe_reading_from("/dev/null"));
  const Answer answer = probe.wait();
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err, Contains("no terminal to ask at: give --yes"));
  CHECK_THAT(answer.out, !Contains("Plug"));
}

TEST_CASE("whoever is asked whether the shaft may turn can say so, say no, or leave",
          "[spec][safety]") {
  const test::ScratchFolder scratch;
  const test::Terminal terminal;
  test::Program probe(scratch.path(), probe_reading_from(terminal.name()));
  REQUIRE(probe.says("Type yes to go on"));
  SECTION("yes") {
    terminal.type("yes\n");
    const Answer answer = probe.wait();
    CHECK_THAT(answer.err, Contains("rpm"));
    CHECK_THAT(answer.out, Contains("Plug"));
  }
  SECTION("anything else is a no") {
    terminal.type("yes please\n");
    const Answer answer = probe.wait();
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("was not cleared to turn"));
    CHECK_THAT(answer.out, !Contains("Plug"));
  }
  SECTION("Ctrl-C") {
    probe.send(SIGINT);
    const Answer answer = probe.wait();
    CHECK(answer.code == 50);
    CHECK_THAT(answer.out, !Contains("Plug"));
  }
}

}  // namespace rvbench
