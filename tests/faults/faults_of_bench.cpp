#include <utility>

#include "tests/faults/fault_kind.hpp"
#include "tests/faults/wall_clock.hpp"

namespace rvbench::test {
namespace {

constexpr double hours_s = 3600;

FaultKind accelerations(std::string name, bool Disturbance::*what) {
  return disturbed(std::move(name), what, Answer::safety_trip, "acceleration", within::trip_s);
}

// What is over at once spoils no more than the record it strikes.
FaultKind in_a_record(FaultKind kind) {
  kind.is_harmless_when = [](BenchState state) {
    return state != BenchState::recording && state != BenchState::recording_again;
  };
  return kind;
}

// What comes in the midst of the last record is not told from vibration: the record is sound for
// too long before.
FaultKind unless_in_last_record(FaultKind kind) {
  kind.is_harmless_when = [](BenchState state) { return state == BenchState::recording_again; };
  return kind;
}

// A supply that breaks down pulls 10 V from a sensor of 10 mV per m/s², of which AC coupling lets
// the jump through. One that was never on makes none.
void switch_iepe_off(FaultBench& bench) {
  bench.disturbance.iepe_off = true;
  bench.disturbance.bias_jump_m_s2 = bench.now_s() > 0 ? 1000 : 0;
}

// Nobody writes samples between records, and an event that is not written ends nothing.
FaultKind disk_full() {
  FaultKind kind;
  kind.name = "disk full";
  kind.strike = [](Victim& victim) { victim.disk_full = true; };
  kind.words = "the recording cannot be written";
  kind.stopped_within_s = within::trip_s;
  kind.shown = Shown::in_next_record;
  return kind;
}

FaultKind wall_clock_steps(std::string name, double seconds) {
  return {std::move(name), [seconds](Victim&) { step_wall_clock(seconds); }, Answer::pass};
}

// The plant's own step is the only wait there is: the drive's watchdog counts from the last
// request.
FaultKind controller_killed() {
  FaultKind kind;
  kind.name = "controller killed";
  kind.strike = [](Victim& victim) { victim.kill_controller(); };
  kind.stopped_within_s = within::watchdog_s;
  kind.cuts_brake_off = true;
  kind.kills_controller = true;
  return kind;
}

}  // namespace

std::vector<FaultKind> faults_of_the_daq() {
  return {
      accelerations("accelerometer open", &Disturbance::channel_open),
      disturbed("accelerometer flat", &Disturbance::channel_flat, Answer::no_pass),
      accelerations("accelerometer clipped", &Disturbance::channel_clipped),
      accelerations("spike", &Disturbance::spike),
      unless_in_last_record(
          disturbed("mains hum", &Disturbance::mains_hum, Answer::no_pass, "mains hum")),
      in_a_record(
          disturbed("accelerometer drifts", &Disturbance::drifts, Answer::no_pass, "drift")),
      on_bench("IEPE supply off", switch_iepe_off, Answer::no_pass),
      disturbed("scans lost", &Disturbance::scans_lost, Answer::no_pass),
      in_a_record(on_bench(
          "DAQ gap", [](FaultBench& bench) { bench.disturbance.scans_to_lose = 60; },
          Answer::no_pass)),
      in_a_record(on_bench(
          "DAQ gap not told", [](FaultBench& bench) { bench.disturbance.scans_to_swallow = 124; },
          Answer::no_pass)),
      on_bench(
          "DAQ hole", [](FaultBench& bench) { bench.disturbance.scans_to_swallow = 620; },
          Answer::device_lost, "accelerometers", within::stale_s),
      disturbed("DAQ stops", &Disturbance::daq_stopped, Answer::device_lost, "accelerometers",
                within::stale_s),
      disturbed("DAQ clock fast", &Disturbance::daq_fast, Answer::no_pass),
  };
}

std::vector<FaultKind> faults_of_the_hall() {
  return {
      on_bench(
          "E-stop", [](FaultBench& bench) { bench.safety.estop_pressed = true; },
          Answer::safety_trip, "emergency stop", within::trip_s),
      on_bench(
          "guard opened", [](FaultBench& bench) { bench.safety.guard_open = true; },
          Answer::safety_trip, "guard", within::trip_s),
      on_bench(
          "over-temperature", [](FaultBench& bench) { bench.safety.housing_temp_degC = 95; },
          Answer::safety_trip, "temperature", within::trip_s),
      disturbed("over-torque", &Disturbance::over_torque, Answer::safety_trip, "torque",
                within::trip_s),
      on_bench(
          "temperature sensor lost",
          [](FaultBench& bench) { bench.safety.housing_temp_degC = not_known; },
          Answer::device_lost, "safety inputs", within::stale_s),
      {"operator aborts", [](Victim& victim) { victim.stop.request_stop(); }, Answer::aborted, "",
       within::trip_s},
      disk_full(),
      on_bench(
          "controller stalls", [](FaultBench& bench) { bench.disturbance.stall_s = 2; },
          Answer::device_lost, "", 2.1),
      controller_killed(),
      wall_clock_steps("wall clock steps forward", 5 * hours_s),
      wall_clock_steps("wall clock steps back", -5 * hours_s),
  };
}

}  // namespace rvbench::test
