#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "analysis/hilbert.hpp"
#include "analysis/spectrum.hpp"
#include "bench/benchmarks/bare_fftw.hpp"
#include "bench/benchmarks/gear_signal.hpp"

namespace {

using namespace rvbench;

// Half of what scipy needs for the same (0.036 s).
void envelope_spectrum_of_one_minute(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  const auto work = [&] {
    benchmark::DoNotOptimize(analysis::amplitude_spectrum(
        analysis::envelope(x), bench::gear_signal_rate_Hz, analysis::Window::rectangular));
  };
  for ([[maybe_unused]] auto _ : state) work();
  const bench::BareFftw fftw(int(x.size()));
  const double transforms = bench::least_cpu_s(20, work) / (2 * fftw.there_s + fftw.back_s);
  state.SetLabel(
      fmt::format("60 s at 4960 Hz; limit 0.018 s; {:.2f} times three bare transforms by FFTW, "
                  "limit 2.2",
                  transforms));
}
BENCHMARK(envelope_spectrum_of_one_minute)->Unit(benchmark::kSecond);

}  // namespace
