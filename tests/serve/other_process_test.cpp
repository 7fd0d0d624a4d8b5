#include "bench/serve/other_process.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;

TEST_CASE("a program is asked, and says what it says and how it ended", "[bench][serve]") {
  const ProgramAnswer said = ask_program({"/bin/sh", "-c", "echo out; echo err >&2; exit 7"});
  CHECK(said.code == 7);
  CHECK(said.out == "out\n");
  CHECK(said.err == "err\n");
  CHECK(ask_program({"/no/such/program"}).code == -1);
}

TEST_CASE("nobody waits for a program that takes too long, or for one after a stop",
          "[bench][serve]") {
  CHECK(ask_program({"/bin/sleep", "3600"}, 0.1).code == -1);
  const rvbench::test::ScratchFolder scratch;
  const std::string begun = (scratch / "begun").string();
  std::stop_source stop;
  std::jthread somebody([&] {
    (void)rvbench::test::wait_until([&] { return std::filesystem::exists(begun); });
    stop.request_stop();
  });
  const std::vector<std::string> slow{"/bin/sh", "-c", "> \"$0\"; exec sleep 3600", begun};
  CHECK(ask_program(slow, 3600, stop.get_token()).code == -1);
  CHECK(std::filesystem::exists(begun));
  CHECK(ask_program({"/bin/sleep", "3600"}, 3600, stop.get_token()).code == -1);  // at once
}

}  // namespace rvbench::bench
