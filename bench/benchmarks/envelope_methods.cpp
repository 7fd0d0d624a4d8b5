#include <benchmark/benchmark.h>

#include "analysis/envelope/kurtogram.hpp"
#include "analysis/envelope/spectral_coherence.hpp"
#include "analysis/envelope/squared_envelope_spectrum.hpp"
#include "analysis/envelope/whitening.hpp"
#include "bench/benchmarks/gear_signal.hpp"

namespace {

using namespace rvbench;

// What the literature's own Python needs for the same is the limit.
void kurtogram_of_one_minute(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(
        analysis::fast_kurtogram(x, bench::gear_signal_rate_Hz, {.levels = 7}));
  }
  state.SetLabel("60 s at 4960 Hz, level 7; limit 0.27 s");
}
BENCHMARK(kurtogram_of_one_minute)->Unit(benchmark::kSecond);

// Every cyclic line up to seven orders of the shaft; no other program was measured.
void coherence_of_one_minute(benchmark::State& state) {
  constexpr double highest_Hz = 7 * 30.25;
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(analysis::enhanced_envelope_spectrum(analysis::spectral_coherence(
        analysis::floor_whitened(x), bench::gear_signal_rate_Hz, {.highest = highest_Hz})));
  }
  state.SetLabel("60 s at 4960 Hz, whitened, 64 bands x 12706 cyclic lines up to 212 Hz");
}
BENCHMARK(coherence_of_one_minute)->Unit(benchmark::kSecond);

void prewhitened_spectrum_of_one_minute(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(analysis::squared_envelope_spectrum(analysis::cepstrum_prewhitened(x),
                                                                 bench::gear_signal_rate_Hz, 0,
                                                                 bench::gear_signal_rate_Hz / 2));
  }
  state.SetLabel("60 s at 4960 Hz, cepstrum pre-whitened, all bands, tested");
}
BENCHMARK(prewhitened_spectrum_of_one_minute)->Unit(benchmark::kSecond);

}  // namespace
