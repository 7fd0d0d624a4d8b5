#include "bench/serve/other_process.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

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
  std::stop_source stop;
  std::jthread somebody([&stop] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop.request_stop();
  });
  CHECK(ask_program({"/bin/sleep", "3600"}, 3600, stop.get_token()).code == -1);
  CHECK(ask_program({"/bin/sleep", "3600"}, 3600, stop.get_token()).code == -1);  // at once
}

}  // namespace rvbench::bench
