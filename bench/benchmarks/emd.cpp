#include "analysis/emd/emd.hpp"

#include <benchmark/benchmark.h>

#include "bench/benchmarks/gear_signal.hpp"

namespace {

using namespace rvbench;

// Twelve channels of a minute in under two seconds of one core, so that a verdict never waits.
void emd_of_one_minute(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(analysis::emd(x, {.imfs = 9, .sifts = 10}));
  }
  state.SetLabel("60 s at 4960 Hz, 9 IMFs x 10 sifts; limit 0.16 s");
}
BENCHMARK(emd_of_one_minute)->Unit(benchmark::kSecond);

}  // namespace
