#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "bench/sha256.hpp"
#include "hal/recording_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench {
namespace {

using sim::BenchWorld;
using sim::NodeFault;
using sim::WireFault;
using test::BenchRun;

struct Fault {
  const char* name;
  const char* told;  // what the reason must name
  int exit_code;
  std::function<void(BenchWorld&)> strike;
  bool also_at_connect = true;  // false: connecting cures it, or cannot know it yet
};

std::function<void(BenchWorld&)> wire(WireFault fault) {
  return [fault](BenchWorld& world) { world.inverter_server().inject({.fault = fault}); };
}

std::function<void(BenchWorld&)> transducer(NodeFault fault) {
  return [fault](BenchWorld& world) { world.transducer().set_fault(fault); };
}

std::function<void(BenchWorld&)> brake(NodeFault fault) {
  return [fault](BenchWorld& world) { world.brake().set_fault(fault); };
}

const std::vector<Fault>& faults() {
  static const std::vector<Fault> all{
      {"inverter killed", "inverter", 30, wire(WireFault::dead)},
      {"inverter frozen", "inverter", 30, wire(WireFault::silent)},
      {"inverter late", "inverter", 30, wire(WireFault::late)},
      {"inverter garbled", "inverter", 30, wire(WireFault::garbled)},
      {"inverter refuses", "inverter", 30, wire(WireFault::busy)},
      {"inverter trips", "the drive has tripped, fault code 2", 30,
       [](BenchWorld& world) { world.inverter().trip(sim::fault_overcurrent); }, false},
      {"transducer silent", "torque ", 30, transducer(NodeFault::silent)},
      {"transducer frozen", "torque ", 30, transducer(NodeFault::frozen)},
      {"transducer garbled", "torque ", 30, transducer(NodeFault::garbled)},
      {"brake silent", "brake", 30, brake(NodeFault::silent)},
      {"brake frozen", "brake", 30, brake(NodeFault::frozen)},
      {"brake garbled", "brake", 30, brake(NodeFault::garbled)},
      {"brake trips", "the brake has tripped", 30, [](BenchWorld& world) { world.brake().trip(); },
       false},
      {"DAQ stopped", "accelerometers", 30, [](BenchWorld& world) { world.stop_daq(); }},
      {"temperature lost", "the housing temperature is not known", 30,
       [](BenchWorld& world) { world.lose_temperature(); }, false},
      {"E-stop", "the emergency stop is pressed", 40,
       [](BenchWorld& world) { world.press_estop(); }},
      {"guard opened", "the guard is open", 40, [](BenchWorld& world) { world.open_guard(); }},
  };
  return all;
}

// The samples before the fault are in the recording, and its point says that it was cut short.
void check_recorded_until(const BenchRun& run, double time_s) {
  const auto reader = hal::RecordingReader::open(run.folder() / "recording.h5");
  REQUIRE(reader);
  REQUIRE(reader.value()->results().size() == 1);
  CHECK(reader.value()->results()[0].status == "interrupted");
  const Result<Recording> point = reader.value()->read(0);
  REQUIRE(point);
  for (const std::string_view name :
       {std::string_view("accel_1x"), std::string_view("accel_4z"), channel_names::input_torque}) {
    CAPTURE(name);
    const Channel* channel = point.value().find(name);
    REQUIRE(channel != nullptr);
    const double end_s = reader.value()->results()[0].t0_s +
                         static_cast<double>(channel->samples.size()) / channel->rate_Hz;
    CHECK(end_s > time_s - 0.05);
  }
  CHECK_FALSE(reader.value()->events().empty());
}

}  // namespace

TEST_CASE("a bench with a fault from the start never turns the shaft", "[spec][safety]") {
  for (const Fault& fault : faults()) {
    if (!fault.also_at_connect) continue;
    DYNAMIC_SECTION(fault.name) {
      BenchRun run;
      fault.strike(run.world());
      CHECK(exit_code(run.go().ending) == fault.exit_code);
      CHECK(std::abs(run.world().plant().input_angle_rad()) < 0.01);
      test::check_told(run, "ERROR", fault.told);
      test::check_at_rest(run);
    }
  }
}

TEST_CASE("a fault at any moment of a run stops the shaft and is told", "[spec][safety]") {
  if (test::too_long_under_sanitizer()) return;
  for (const auto& [moment, at_s] : {std::pair{"warm-up", 0.6}, {"speed change", 1.6}}) {
    for (const Fault& fault : faults()) {
      DYNAMIC_SECTION(fault.name << " during " << moment) {
        BenchRun run;
        run.world().at(at_s, [&] { fault.strike(run.world()); });
        CHECK(exit_code(run.go().ending) == fault.exit_code);
        test::check_told(run, "ERROR", fault.told);
        test::check_at_rest(run);
      }
    }
  }
}

TEST_CASE("a fault during a record leaves the samples before it", "[spec][safety]") {
  constexpr double at_s = 4;
  for (const Fault& fault : faults()) {
    DYNAMIC_SECTION(fault.name) {
      BenchRun run;
      run.world().at(at_s, [&] { fault.strike(run.world()); });
      CHECK(exit_code(run.go().ending) == fault.exit_code);
      test::check_told(run, "ERROR", fault.told);
      check_recorded_until(run, at_s);
      test::check_at_rest(run);
      // A trip is acted on within two ticks; a silent device when its last value is stale, which
      // waiting for its answers in vain may put off by four of the inverter's time-outs.
      const double told_s = run.told_s(fault.told);
      CHECK(told_s >= at_s);
      CHECK(told_s <= at_s + (fault.exit_code == 40 ? 0.02 : 0.3 + 0.4 + 0.01));
    }
  }
}

TEST_CASE("a fault during teardown changes nothing about the stop, and is told", "[spec][safety]") {
  if (test::too_long_under_sanitizer()) return;
  const std::string unsettled = test::unsettled_plan();  // teardown starts at 2.2 s
  SECTION("no fault") {
    BenchRun run;
    CHECK(exit_code(run.go(unsettled).ending) == 20);
    test::check_at_rest(run);
  }
  for (const Fault& fault : faults()) {
    DYNAMIC_SECTION(fault.name) {
      BenchRun run;
      run.world().at(2.5, [&] { fault.strike(run.world()); });
      CHECK(exit_code(run.go(unsettled).ending) == fault.exit_code);
      test::check_told(run, "ERROR", fault.told);
      test::check_at_rest(run);
    }
  }
}

TEST_CASE("a stop on request ends ABORTED, and a trip during its teardown as a trip",
          "[spec][safety]") {
  for (const Fault& fault : faults()) {
    const bool one_of_a_kind = std::string(fault.name).find("silent") != std::string::npos ||
                               fault.exit_code == 40 ||
                               fault.name == std::string("inverter killed");
    if (!one_of_a_kind) continue;
    DYNAMIC_SECTION(fault.name) {
      BenchRun run;
      run.world().at(3, [&] { run.stop().request_stop(); });
      run.world().at(3.5, [&] { fault.strike(run.world()); });
      CHECK(exit_code(run.go().ending) == (fault.exit_code == 40 ? 40 : 50));
      test::check_at_rest(run);
    }
  }
}

TEST_CASE("a drive whose watchdog cannot be trusted is not armed", "[spec][safety]") {
  using sim::CommLossAction;
  for (const auto& [inverter, reason] :
       {std::pair{sim::InverterParameters{.comm_loss_timeout_s = 0}, "watchdog is off"},
        {sim::InverterParameters{.comm_loss_timeout_s = 2.5}, "waits 2.5 s, at most 2 s is safe"},
        {sim::InverterParameters{.comm_loss_action = CommLossAction::ignore},
         "does not stop the motor"}}) {
    DYNAMIC_SECTION(reason) {
      BenchRun run(inverter);
      CHECK(exit_code(run.go().ending) == 30);
      CHECK(std::abs(run.world().plant().input_angle_rad()) < 0.01);
      test::check_told(run, "ERROR", reason);
      test::check_at_rest(run);
    }
  }
  SECTION("2 s are allowed") {
    BenchRun run({.comm_loss_timeout_s = 2});
    run.world().at(2, [&] { run.stop().request_stop(); });
    CHECK(exit_code(run.go().ending) == 50);
    CHECK(run.world().plant().input_angle_rad() > 1);
  }
}

TEST_CASE("with the link dead the drive's own watchdog stops the motor, even by coasting",
          "[spec][safety]") {
  BenchRun run({.comm_loss_action = sim::CommLossAction::coast});
  run.world().at(4, [&] { run.world().inverter_server().inject({.fault = WireFault::silent}); });
  CHECK(exit_code(run.go().ending) == 30);
  CHECK(run.world().inverter().state().fault_code == sim::fault_comm_loss);
  test::check_at_rest(run);
}

TEST_CASE("a drive that ramps down slowly is given the time that the plan allows",
          "[spec][safety]") {
  // 40 Hz at 1.5 Hz/s: 27 s.
  BenchRun run({.ramp_down_Hz_per_s = 1.5});
  run.world().at(3, [&] { run.stop().request_stop(); });
  run.go(test::replaced(test::short_plan, "\"main\"",
                        "\"teardown\": {\"standstill_timeout_s\": 60}, \"main\""));
  CHECK(exit_code(run.judgement().ending) == 50);
  CHECK(run.judgement().facts.shaft_stopped);
  CHECK_FALSE(run.world().inverter().state().tripped);
  test::check_at_rest(run);
}

TEST_CASE("overload and heat trip before anything breaks", "[spec][safety]") {
  const auto trips = [](const std::string& plan, const char* reason) {
    BenchRun run;
    CHECK(exit_code(run.go(plan).ending) == 40);
    test::check_told(run, "ERROR", reason);
    test::check_at_rest(run);
  };
  // Half the rated load takes 0.69 N·m plus friction at the input; the ramp-up takes more.
  SECTION("torque") {
    trips(test::replaced(test::short_plan, "\"input_torque_Nm\": 8", "\"input_torque_Nm\": 0.9"),
          "is above the interlock's 0.9 N·m");
  }
  SECTION("temperature: the housing starts at 22 degC and warms by its losses") {
    trips(test::replaced(test::short_plan, "\"housing_temp_degC\": 60",
                         "\"housing_temp_degC\": 22.01"),
          "is above the interlock's 22.01 degC");
  }
}

}  // namespace rvbench
