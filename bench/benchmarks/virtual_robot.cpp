#include <benchmark/benchmark.h>

#include "sim/robot/hammer_test.hpp"
#include "sim/robot/operation.hpp"

namespace {

using namespace rvbench;

// A proof takes dozens of robots: 90 hits and three motions each.
void virtual_robot(benchmark::State& state) {
  sim::RobotOptions options;
  options.hit_s = 1;
  options.threads = 1;
  for ([[maybe_unused]] auto _ : state) {
    const sim::VirtualRobot robot(options);
    benchmark::DoNotOptimize(sim::hammer_test(robot));
    for (const sim::RobotMotion motion : sim::robot_motions) {
      benchmark::DoNotOptimize(sim::operate(robot, motion));
    }
  }
  state.SetLabel("90 hits of 1 s, three motions of 20 s, 42 sensors, one core; limit 3 s");
}
BENCHMARK(virtual_robot)->Unit(benchmark::kSecond);

}  // namespace
