#include "bench/run_log.hpp"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "bench/text_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using rvbench::test::ScratchFolder;

struct Silent {
  std::ostringstream out;
  Console console{out, out};
  ProgressBar bar{console, ProgressBar::Style::silent};
};

}  // namespace

TEST_CASE("a log goes on after a line that a killed run left half-written", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch / "log.jsonl";
  write_file(file,
             "{\"utc\":\"x\",\"time_s\":1,\"event\":\"armed\"}\n{\"utc\":\"x\",\"time_s\":2,\"ev");
  {
    Silent silent;
    RunLog log(file, silent.bar);
    log.event(3, "resumed");
  }
  Silent silent;
  const RunLog again(file, silent.bar);
  REQUIRE(again.events().size() == 2);
  CHECK(again.events()[0] == std::pair<double, std::string>(1, "armed"));
  CHECK(again.events()[1] == std::pair<double, std::string>(3, "resumed"));
}

TEST_CASE("lines of a log that are no events are passed over", "[bench]") {
  const ScratchFolder scratch;
  const auto file = scratch / "log.jsonl";
  write_file(file,
             "7\n[]\nnot json\n{\"time_s\":\"1\",\"event\":\"a\"}\n{\"time_s\":1,\"event\":2}\n"
             "{\"time_s\":1,\"event\":\"armed\"}\n");
  Silent silent;
  const RunLog log(file, silent.bar);
  REQUIRE(log.events().size() == 1);
  CHECK(log.events()[0].second == "armed");
}

}  // namespace rvbench::bench
