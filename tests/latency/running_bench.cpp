#include "tests/latency/running_bench.hpp"

#include <stdexcept>

namespace rvbench::test {
namespace {

constexpr double patience_s = 10;

void require(const Status& status) {
  if (!status) throw std::runtime_error(describe(status.error()));
}

}  // namespace

void connect(hal::Rig& rig) {
  require(rig.safety->connect());
  require(rig.torque_sensor->connect());
  require(rig.accelerometers->connect());
  require(rig.accelerometers->start());
  require(rig.brake->connect());
  require(rig.drive->connect());
}

RunningBench::RunningBench(hal::Rig& rig, double speed_rpm)
    : rig_(rig),
      supervisor_(rig, bench_limits),
      devices_(rig, supervisor_),
      next_tick_s_(rig.clock->now_s()) {
  devices_.start();
  for (const double until_s = next_tick_s_ + patience_s; !devices_.all_answered(); tick()) {
    if (supervisor_.latched()) throw std::runtime_error(supervisor_.latched()->reason);
    if (rig.clock->now_s() > until_s) throw std::runtime_error("not every device answers");
  }
  supervisor_.handle(sequences::SupervisorEvent::reset);
  supervisor_.handle(sequences::SupervisorEvent::arm);
  supervisor_.handle(sequences::SupervisorEvent::run);
  speed_rpm_ = speed_rpm;
}

void RunningBench::tick() {
  rig_.clock->wait_until(next_tick_s_);
  next_tick_s_ = std::max(next_tick_s_, rig_.clock->now_s()) + 0.01;
  devices_.read();
  if (supervisor_.latched() || rig_.clock->now_s() < next_write_s_) return;
  next_write_s_ = rig_.clock->now_s() + 0.095;
  devices_.write(speed_rpm_, 0);
}

void RunningBench::run_for(double duration_s) {
  const double until_s = rig_.clock->now_s() + duration_s;
  while (rig_.clock->now_s() < until_s) tick();
}

bool RunningBench::run_until_tripped() {
  const double until_s = rig_.clock->now_s() + patience_s;
  while (!supervisor_.latched()) {
    if (rig_.clock->now_s() > until_s) return false;
    tick();
  }
  return true;
}

}  // namespace rvbench::test
