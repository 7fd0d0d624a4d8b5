#include "tests/faults/fault_kind.hpp"

namespace rvbench::test {
namespace {

using sim::NodeFault;
using sim::WireFault;

constexpr double trip_s = 0.025;  // a tick of 10 ms, and one more for the command
constexpr double stale_s = 0.6;   // staleness, retries and a tick
// Staleness, a call under way (four response time-outs), a tick, then silence until the drive's own
// watchdog acts after 0.5 s.
constexpr double link_dead_s = 0.3 + 4 * 0.05 + 0.01 + 0.5 + 0.01;

FaultKind wire(std::string name, WireFault fault, Answer answer, double within_s,
               int requests = 1'000'000) {
  return {
      std::move(name),
      [=](Victim& victim) { victim.bench.server.inject({.fault = fault, .requests = requests}); },
      answer, answer == Answer::device_lost ? "drive" : "", within_s};
}

FaultKind transducer(std::string name, NodeFault fault) {
  return {std::move(name), [=](Victim& victim) { victim.bench.transducer.set_fault(fault); },
          Answer::device_lost, "torque sensor", stale_s};
}

FaultKind brake(std::string name, NodeFault fault) {
  return {std::move(name),
          [=](Victim& victim) { victim.bench.brake.set_fault(fault); },
          Answer::device_lost,
          "brake",
          stale_s,
          fault == NodeFault::silent};
}

FaultKind disturbed(std::string name, bool Disturbance::*what, Answer answer, std::string words,
                    double within_s = 1e9) {
  return {std::move(name), [=](Victim& victim) { victim.bench.disturbance.*what = true; }, answer,
          std::move(words), within_s};
}

// A drive that would run on for ever once its cable is pulled: nothing may turn.
FaultKind unwatched(std::string name, const sim::InverterParameters& drive) {
  FaultKind kind = wire(std::move(name), WireFault::dead, Answer::device_lost, 0);
  kind.words = "watchdog";
  kind.drive = drive;
  kind.holds_from_start = true;
  return kind;
}

// Found by the next change of speed.
FaultKind speed_register_stuck() {
  FaultKind kind = disturbed("speed register stuck", &Disturbance::speed_stuck, Answer::device_lost,
                             "the drive reports");
  kind.is_harmless_when = [](BenchState state) { return state >= BenchState::settling; };
  return kind;
}

std::vector<FaultKind> of_the_drive() {
  return {
      wire("one reply late", WireFault::late, Answer::pass, 1e9, 1),
      wire("one reply lost", WireFault::silent, Answer::pass, 1e9, 1),
      wire("one reply garbled", WireFault::garbled, Answer::pass, 1e9, 1),
      wire("one reply truncated", WireFault::truncated, Answer::pass, 1e9, 1),
      wire("one reply doubled", WireFault::doubled, Answer::pass, 1e9, 1),
      wire("one exception reply", WireFault::busy, Answer::pass, 1e9, 1),
      wire("replies late", WireFault::late, Answer::device_lost, link_dead_s),
      wire("replies lost", WireFault::silent, Answer::device_lost, link_dead_s),
      wire("replies garbled", WireFault::garbled, Answer::device_lost, link_dead_s),
      wire("replies truncated", WireFault::truncated, Answer::device_lost, link_dead_s),
      wire("exception replies", WireFault::busy, Answer::device_lost, link_dead_s),
      wire("cable pulled", WireFault::dead, Answer::device_lost, link_dead_s),
      wire("drive deaf", WireFault::deaf, Answer::no_pass, 1e9),
      {"readings frozen", [](Victim& v) { v.bench.server.inject({.fault = WireFault::frozen}); },
       Answer::no_pass, "", 1e9, false, true},
      speed_register_stuck(),
      unwatched("watchdog off", {.comm_loss_timeout_s = 0}),
      unwatched("watchdog slow", {.comm_loss_timeout_s = 30}),
      unwatched("watchdog toothless",
                {.comm_loss_timeout_s = 0.5, .comm_loss_action = sim::CommLossAction::ignore}),
      {"drive trips", [](Victim& v) { v.bench.inverter.trip(sim::fault_overcurrent); },
       Answer::device_lost, "", 0.01},
      {"panel takes over", [](Victim& v) { v.bench.inverter.take_over(sim::RunCommand::stop, 0); },
       Answer::device_lost, "", 1e9},
  };
}

std::vector<FaultKind> of_the_bus() {
  return {
      transducer("transducer silent", NodeFault::silent),
      transducer("transducer frozen", NodeFault::frozen),
      transducer("transducer garbled", NodeFault::garbled),
      {"transducer overloaded", [](Victim& v) { v.bench.transducer.set_flags({.overload = true}); },
       Answer::device_lost, "torque sensor", stale_s},
      {"shunt on", [](Victim& v) { v.bench.transducer.set_flags({.shunt_on = true}); },
       Answer::device_lost, "torque sensor", stale_s},
      {"one torque frame lost", [](Victim& v) { v.bench.transducer.lose_frames(1); }, Answer::pass,
       "", 1e9},
      {"frames doubled",
       [](Victim& v) {
         v.bench.transducer.set_fault(NodeFault::duplicated);
         v.bench.brake.set_fault(NodeFault::duplicated);
       },
       Answer::pass, "", 1e9},
      {"bus silent",
       [](Victim& v) {
         v.bench.transducer.set_fault(NodeFault::silent);
         v.bench.brake.set_fault(NodeFault::silent);
       },
       Answer::device_lost, "", stale_s, true},
      {"bus flooded",
       [](Victim& v) {
         for (int i = 0; i < 5000; ++i) {
           (void)v.bench.bus.nodes->send({.id = std::uint32_t(0x100 + i % 32), .length = 8});
         }
       },
       Answer::pass, "", 1e9},
      brake("brake silent", NodeFault::silent),
      brake("brake frozen", NodeFault::frozen),
      {"brake trips", [](Victim& v) { v.bench.brake.trip(); }, Answer::device_lost, "brake",
       stale_s},
      disturbed("torque sign flipped", &Disturbance::torque_inverted, Answer::no_pass, ""),
      disturbed("torque frames lost", &Disturbance::torque_lossy, Answer::no_pass, ""),
      disturbed("encoder stuck", &Disturbance::angle_stuck, Answer::device_lost,
                "the torque sensor's angle 0 rpm"),
  };
}

std::vector<FaultKind> of_the_daq() {
  return {
      disturbed("accelerometer open", &Disturbance::channel_open, Answer::safety_trip,
                "acceleration", trip_s),
      disturbed("accelerometer flat", &Disturbance::channel_flat, Answer::no_pass, ""),
      disturbed("accelerometer clipped", &Disturbance::channel_clipped, Answer::safety_trip,
                "acceleration", trip_s),
      disturbed("spike", &Disturbance::spike, Answer::safety_trip, "acceleration", trip_s),
      disturbed("scans lost", &Disturbance::scans_lost, Answer::no_pass, ""),
      disturbed("DAQ stops", &Disturbance::daq_stopped, Answer::device_lost, "accelerometers",
                stale_s),
      disturbed("DAQ clock fast", &Disturbance::daq_fast, Answer::no_pass, ""),
  };
}

std::vector<FaultKind> of_the_hall() {
  return {
      {"E-stop", [](Victim& v) { v.bench.safety.estop_pressed = true; }, Answer::safety_trip,
       "emergency stop", trip_s},
      {"guard opened", [](Victim& v) { v.bench.safety.guard_open = true; }, Answer::safety_trip,
       "guard", trip_s},
      {"over-temperature", [](Victim& v) { v.bench.safety.housing_temp_degC = 95; },
       Answer::safety_trip, "temperature", trip_s},
      disturbed("over-torque", &Disturbance::over_torque, Answer::safety_trip, "torque", trip_s),
      {"temperature sensor lost", [](Victim& v) { v.bench.safety.housing_temp_degC = not_known; },
       Answer::device_lost, "safety inputs", stale_s},
      {"operator aborts", [](Victim& v) { v.stop.request_stop(); }, Answer::aborted, "", trip_s},
      {"disk full", [](Victim& v) { v.disk_full = true; }, Answer::no_pass, "", 1e9},
      {"controller stalls", [](Victim& v) { v.bench.disturbance.stall_s = 2; }, Answer::device_lost,
       "", 2.1},
  };
}

}  // namespace

const std::vector<FaultKind>& fault_kinds() {
  static const std::vector<FaultKind> kinds = [] {
    std::vector<FaultKind> all;
    for (const auto& group : {of_the_drive(), of_the_bus(), of_the_daq(), of_the_hall()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kinds;
}

}  // namespace rvbench::test
