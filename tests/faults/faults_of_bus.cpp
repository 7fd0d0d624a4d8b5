#include <utility>

#include "tests/faults/fault_kind.hpp"

namespace rvbench::test {
namespace {

using sim::NodeFault;

FaultKind transducer(std::string name, NodeFault fault) {
  return on_bench(
      std::move(name), [fault](FaultBench& bench) { bench.transducer.set_fault(fault); },
      Answer::device_lost, "torque sensor", within::stale_s);
}

FaultKind flagged(std::string name, sim::TransducerFlags flags) {
  return on_bench(
      std::move(name), [flags](FaultBench& bench) { bench.transducer.set_flags(flags); },
      Answer::device_lost, "torque sensor", within::stale_s);
}

FaultKind brake(std::string name, NodeFault fault) {
  return on_bench(
      std::move(name), [fault](FaultBench& bench) { bench.brake.set_fault(fault); },
      Answer::device_lost, "brake", within::stale_s);
}

FaultKind both(std::string name, NodeFault fault, Answer answer, double stopped_within_s) {
  return on_bench(
      std::move(name),
      [fault](FaultBench& bench) {
        bench.transducer.set_fault(fault);
        bench.brake.set_fault(fault);
      },
      answer, "", stopped_within_s);
}

FaultKind cutting_brake_off(FaultKind kind) {
  kind.cuts_brake_off = true;
  return kind;
}

void flood(FaultBench& bench) {
  for (int i = 0; i < 5000; ++i) {
    (void)bench.bus.nodes->send({.id = std::uint32_t(0x100 + i % 32), .length = 8});
  }
}

// A controller that is bus-off before it is opened is opened anew.
FaultKind bus_off() {
  FaultKind kind = cutting_brake_off(
      disturbed("bus-off", &Disturbance::bus_off, Answer::device_lost, "bus-off", within::stale_s));
  kind.is_harmless_when = [](BenchState state) { return state == BenchState::connecting; };
  return kind;
}

}  // namespace

std::vector<FaultKind> faults_of_the_bus() {
  return {
      transducer("transducer silent", NodeFault::silent),
      transducer("transducer frozen", NodeFault::frozen),
      transducer("transducer garbled", NodeFault::garbled),
      flagged("transducer overloaded", {.overload = true}),
      flagged("shunt on", {.shunt_on = true}),
      on_bench(
          "one torque frame lost", [](FaultBench& bench) { bench.transducer.lose_frames(1); },
          Answer::pass),
      both("frames doubled", NodeFault::duplicated, Answer::pass, 1e9),
      cutting_brake_off(
          both("bus silent", NodeFault::silent, Answer::device_lost, within::stale_s)),
      bus_off(),
      on_bench("bus flooded", flood, Answer::pass),
      cutting_brake_off(brake("brake silent", NodeFault::silent)),
      brake("brake frozen", NodeFault::frozen),
      on_bench(
          "brake trips", [](FaultBench& bench) { bench.brake.trip(); }, Answer::device_lost,
          "brake", within::stale_s),
      disturbed("torque sign flipped", &Disturbance::torque_inverted, Answer::no_pass),
      disturbed("torque frames lost", &Disturbance::torque_lossy, Answer::no_pass),
      disturbed("encoder stuck", &Disturbance::angle_stuck, Answer::device_lost,
                "the torque sensor's angle 0 rpm",
                within::ramp_from_rest_s + within::contradicted_s),
  };
}

}  // namespace rvbench::test
