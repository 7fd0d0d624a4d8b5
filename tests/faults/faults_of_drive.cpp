#include <array>
#include <string>
#include <utility>

#include "tests/faults/fault_kind.hpp"

namespace rvbench::test {
namespace {

using sim::WireFault;

// By the Modbus specification: illegal function, address and value, device failure, acknowledge,
// busy, parity of the memory, gateway without a path, gateway without an answer.
constexpr std::array exception_codes{1, 2, 3, 4, 5, 6, 8, 10, 11};

// A passing hiccup: the next request is answered well.
FaultKind once(std::string name, WireFault fault) {
  return on_bench(
      std::move(name),
      [fault](FaultBench& bench) { bench.server.inject({.fault = fault, .requests = 1}); },
      Answer::pass);
}

FaultKind for_ever(std::string name, sim::WireFaultPlan plan) {
  return on_bench(
      std::move(name), [plan](FaultBench& bench) { bench.server.inject(plan); },
      Answer::device_lost, "drive", within::link_dead_s);
}

FaultKind one_exception() {
  return {"one exception reply",
          [](Victim& victim) {
            victim.bench.server.inject(
                {.fault = WireFault::busy,
                 .requests = 1,
                 .exception_code = exception_codes[victim.seed % exception_codes.size()]});
          },
          Answer::pass};
}

// A drive that would run on for ever once its cable is pulled: nothing may turn.
FaultKind unwatched(std::string name, const sim::InverterParameters& drive) {
  FaultKind kind = for_ever(std::move(name), {.fault = WireFault::dead});
  kind.words = "watchdog";
  kind.stopped_within_s = 0;
  kind.drive = drive;
  kind.holds_from_start = true;
  return kind;
}

// The last change of speed is over: what the drive does or tells agrees with it.
bool is_at_last_speed(BenchState state) { return state >= BenchState::settling_again; }

FaultKind until_last_speed(FaultKind kind) {
  kind.is_harmless_when = is_at_last_speed;
  return kind;
}

// Both speeds agree until they ought to change.
FaultKind shown_at_next_speed(FaultKind kind) {
  kind.shown = Shown::at_next_speed;
  kind.stopped_within_s = within::ramp_apart_s + within::contradicted_s;
  return kind;
}

FaultKind readings_frozen() {
  FaultKind kind = shown_at_next_speed(on_bench(
      "readings frozen",
      [](FaultBench& bench) { bench.server.inject({.fault = WireFault::frozen}); },
      Answer::no_pass));
  kind.hides_standstill = true;
  return kind;
}

// That a speed is not reached spoils the points; that a stop is not obeyed ends the run.
FaultKind drive_deaf() {
  FaultKind kind = until_last_speed(on_bench(
      "drive deaf", [](FaultBench& bench) { bench.server.inject({.fault = WireFault::deaf}); },
      Answer::no_pass));
  kind.shown = Shown::at_stop;
  kind.stopped_within_s = within::disobeyed_s;
  return kind;
}

std::vector<FaultKind> of_the_link() {
  std::vector<FaultKind> kinds{
      once("one reply late", WireFault::late),
      once("one reply lost", WireFault::silent),
      once("one reply garbled", WireFault::garbled),
      once("one reply truncated", WireFault::truncated),
      once("one reply doubled", WireFault::doubled),
      once("two replies merged", WireFault::merged),
      one_exception(),
      for_ever("replies late", {.fault = WireFault::late}),
      for_ever("replies lost", {.fault = WireFault::silent}),
      for_ever("replies garbled", {.fault = WireFault::garbled}),
      for_ever("replies truncated", {.fault = WireFault::truncated}),
      for_ever("cable pulled", {.fault = WireFault::dead}),
      unwatched("watchdog off", {.comm_loss_timeout_s = 0}),
      unwatched("watchdog slow", {.comm_loss_timeout_s = 30}),
      unwatched("watchdog toothless",
                {.comm_loss_timeout_s = 0.5, .comm_loss_action = sim::CommLossAction::ignore}),
  };
  for (const int code : exception_codes) {
    kinds.push_back(for_ever("exception " + std::to_string(code) + " replies",
                             {.fault = WireFault::busy, .exception_code = code}));
  }
  return kinds;
}

}  // namespace

std::vector<FaultKind> faults_of_the_drive() {
  std::vector<FaultKind> kinds = of_the_link();
  kinds.push_back(drive_deaf());
  kinds.push_back(readings_frozen());
  kinds.push_back(shown_at_next_speed(
      until_last_speed(disturbed("speed register stuck", &Disturbance::speed_stuck,
                                 Answer::device_lost, "the drive reports"))));
  kinds.push_back(on_bench(
      "drive trips", [](FaultBench& bench) { bench.inverter.trip(sim::fault_overcurrent); },
      Answer::device_lost, "", within::at_plants_step_s));
  kinds.push_back(on_bench(
      "panel takes over",
      [](FaultBench& bench) { bench.inverter.take_over(sim::RunCommand::stop, 0); },
      Answer::device_lost, "panel", within::at_plants_step_s));
  return kinds;
}

}  // namespace rvbench::test
