#include <benchmark/benchmark.h>

#include "sim/rv_bench.hpp"

namespace {

using namespace rvbench;

// The whole matrix of a plan in minutes: the simulated bench must outrun the real one by far.
void simulated_bench(benchmark::State& state) {
  sim::RvBench bench(sim::draw_unit("healthy", 1));
  bench.set_supply(40, true);
  bench.set_brake_torque(167);
  Eigen::VectorXf scan(sim::RvBench::sensors);
  constexpr auto scans_per_second = static_cast<int>(sim::RvBench::rate_Hz);
  for ([[maybe_unused]] auto _ : state) {
    for (int i = 0; i < scans_per_second; ++i) bench.step(scan);
    benchmark::DoNotOptimize(scan.data());
  }
  state.counters["x_real_time"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  state.SetLabel("1 s of the bench, 12 channels; limit 40x");
}
BENCHMARK(simulated_bench)->Unit(benchmark::kMillisecond)->MinTime(3);

}  // namespace
