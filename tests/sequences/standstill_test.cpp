#include "sequences/standstill.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "tests/sequences/run_fixture.hpp"

using namespace rvbench;
using hal::MirrorFault;
using test::Run;

namespace {

// What the log says of the teardown; empty if nothing.
std::string told_in_teardown(const Run& run) {
  for (const auto& [stopped, text] : run.observer.events) {
    if (text.find("in teardown: ") == 0) return text;
  }
  return "";
}

}  // namespace

TEST_CASE("with a dead drive it is told that the shaft's angle showed the standstill",
          "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_dead, 12);
  CHECK(run.go().shaft_stopped);
  CHECK_THAT(told_in_teardown(run), Catch::Contains("drive silent for") &&
                                        Catch::Contains("standstill was measured by the shaft's "
                                                        "angle"));
}

TEST_CASE("with a dead torque sensor it is told that only the drive knows", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::torque_sensor_dead, 12);
  CHECK(run.go().shaft_stopped);
  CHECK_THAT(told_in_teardown(run),
             Catch::Contains("standstill is what the drive says") && Catch::Contains("lost"));
}

TEST_CASE("with neither it is told that nothing confirmed the standstill", "[sequences][safety]") {
  Run run;
  run.world().schedule(MirrorFault::drive_dead, 12);
  run.world().schedule(MirrorFault::torque_sensor_dead, 12);
  CHECK_FALSE(run.go().shaft_stopped);
  CHECK_THAT(told_in_teardown(run),
             Catch::Contains("could not be confirmed") && Catch::Contains("by its own watchdog"));
}

TEST_CASE("a shaft that goes on turning is told with its speed", "[sequences][safety]") {
  Run run({.ramp_rpm_s = 40});  // 1815 rpm take 45 s, and it is heard again at 11 s
  auto text = test::small_plan;
  text.insert(text.rfind('}'), R"(, "teardown": {"standstill_timeout_s": 11.2})");
  CHECK_FALSE(run.go(text).shaft_stopped);
  CHECK_THAT(told_in_teardown(run), Catch::Contains("the shaft does not stop") &&
                                        Catch::Contains("the shaft's angle still shows"));
}

TEST_CASE("a run without a fault has nothing to tell of its teardown", "[sequences]") {
  Run run;
  CHECK(run.go().shaft_stopped);
  CHECK(told_in_teardown(run).empty());
}
