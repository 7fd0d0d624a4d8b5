#include "analysis/emd/emd.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "analysis/emd/ensemble_emd.hpp"
#include "analysis/emd/live_emd.hpp"
#include "bench/benchmarks/bare_fftw.hpp"
#include "bench/benchmarks/gear_signal.hpp"
#include "hal/types/parallel_for.hpp"

namespace {

using namespace rvbench;

constexpr std::size_t channels = 12;
constexpr unsigned cores = 2;

void decompose(const Eigen::VectorXd& x) {
  benchmark::DoNotOptimize(analysis::emd(x, {.imfs = 9, .sifts = 10}));
}

void emd_of_one_minute(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) decompose(x);
  const bench::BareFftw fftw(int(x.size()));
  const double pairs = bench::least_cpu_s(5, [&] { decompose(x); }) / (fftw.there_s + fftw.back_s);
  state.SetLabel(
      fmt::format("60 s at 4960 Hz, 9 IMFs x 10 sifts; as {:.1f} pairs of FFTs by FFTW "
                  "of that length, limit 25",
                  pairs));
}
BENCHMARK(emd_of_one_minute)->Unit(benchmark::kSecond);

void emd_of_ten_minutes(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(600);
  const Eigen::VectorXd start = x.head(x.size() / 60);
  for ([[maybe_unused]] auto _ : state) decompose(x);
  const double whole_s = bench::least_cpu_s(2, [&] { decompose(x); }) / double(x.size());
  const double start_s = bench::least_cpu_s(10, [&] { decompose(start); }) / double(start.size());
  state.SetLabel(
      fmt::format("600 s: each sample costs {:.2f} times what one of 10 s does, limit "
                  "1.3",
                  whole_s / start_s));
}
BENCHMARK(emd_of_ten_minutes)->Unit(benchmark::kSecond);

void emd_of_twelve_channels(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) {
    parallel_for(
        channels, [&](std::size_t) { decompose(x); }, cores);
  }
  state.SetLabel("12 channels of 60 s on 2 cores, elapsed; limit 0.7 s");
}
BENCHMARK(emd_of_twelve_channels)->Unit(benchmark::kSecond)->UseRealTime();

void ceemdan_of_ten_seconds(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(10);
  const analysis::EnsembleOptions options{.members = 100, .threads = cores};
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(analysis::ceemdan(x, options));
  state.SetLabel("10 s at 4960 Hz, 100 members on 2 cores, elapsed; limit 2 s");
}
BENCHMARK(ceemdan_of_ten_seconds)->Unit(benchmark::kSecond)->UseRealTime();

// How long after its samples an IMF is known, at the worst, beyond the step they came in.
std::string latencies_s(const Eigen::VectorXd& x, Eigen::Index step, int imfs) {
  analysis::LiveEmd live({.imfs = imfs, .sifts = 10});
  std::vector<Eigen::Index> worst(std::size_t(imfs), 0);
  for (Eigen::Index known = 0; known + step <= x.size(); known += step) {
    live.add(x.segment(known, step));
    for (int imf = 0; imf < imfs; ++imf) {
      worst[std::size_t(imf)] = std::max(worst[std::size_t(imf)], known + step - live.done(imf));
    }
  }
  std::string listed;
  for (const Eigen::Index samples : worst) {
    listed += fmt::format(" {:.2g}", double(samples) / bench::gear_signal_rate_Hz);
  }
  return listed;
}

// Half a minute in steps of a second, as it comes from the bench.
void live_emd_of_twelve_channels(benchmark::State& state) {
  constexpr double duration_s = 30;
  constexpr int imfs = 9;
  const Eigen::VectorXd x = bench::gear_signal(duration_s);
  const auto second = static_cast<Eigen::Index>(bench::gear_signal_rate_Hz);
  for ([[maybe_unused]] auto _ : state) {
    parallel_for(
        channels,
        [&](std::size_t) {
          analysis::LiveEmd live({.imfs = imfs, .sifts = 10});
          for (Eigen::Index known = 0; known + second <= x.size(); known += second) {
            live.add(x.segment(known, second));
            for (int imf = 0; imf <= imfs; ++imf) benchmark::DoNotOptimize(live.take(imf));
          }
        },
        cores);
  }
  state.counters["x_real_time"] =
      benchmark::Counter(duration_s, benchmark::Counter::kIsIterationInvariantRate);
  state.SetLabel("12 channels in steps of 1 s on 2 cores, elapsed; limit 15x; IMFs 1-9 are known" +
                 latencies_s(bench::gear_signal(120), second, imfs) + " s later");
}
BENCHMARK(live_emd_of_twelve_channels)->Unit(benchmark::kSecond)->UseRealTime();

}  // namespace
