#include "analysis/emd/emd.hpp"

#include <benchmark/benchmark.h>
#include <fftw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "analysis/emd/ensemble_emd.hpp"
#include "analysis/emd/live_emd.hpp"
#include "bench/benchmarks/gear_signal.hpp"
#include "hal/types/parallel_for.hpp"

namespace {

using namespace rvbench;

constexpr std::size_t channels = 12;
constexpr unsigned cores = 2;

double cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// The least of several tries: what others do on the computer only adds.
template <typename Work>
double least_cpu_s(int tries, const Work& work) {
  double least_s = std::numeric_limits<double>::infinity();
  for (int i = 0; i < tries; ++i) {
    const double start_s = cpu_s();
    work();
    least_s = std::min(least_s, cpu_s() - start_s);
  }
  return least_s;
}

void decompose(const Eigen::VectorXd& x) {
  benchmark::DoNotOptimize(analysis::emd(x, {.imfs = 9, .sifts = 10}));
}

// There and back by FFTW, planned as for a length that comes once.
double fftw_pair_s(Eigen::Index samples) {
  const int n = static_cast<int>(samples);
  std::vector<double> time(std::size_t(n), 1);
  std::vector<fftw_complex> lines(std::size_t(n) / 2 + 1);
  const fftw_plan there = fftw_plan_dft_r2c_1d(n, time.data(), lines.data(), FFTW_ESTIMATE);
  const fftw_plan back = fftw_plan_dft_c2r_1d(n, lines.data(), time.data(), FFTW_ESTIMATE);
  const double least_s = least_cpu_s(20, [&] {
    std::fill(time.begin(), time.end(), 1);
    fftw_execute(there);
    fftw_execute(back);
  });
  fftw_destroy_plan(there);
  fftw_destroy_plan(back);
  return least_s;
}

void emd_of_one_minute(benchmark::State& state) {
  const Eigen::VectorXd x = bench::gear_signal(60);
  for ([[maybe_unused]] auto _ : state) decompose(x);
  const double pairs = least_cpu_s(5, [&] { decompose(x); }) / fftw_pair_s(x.size());
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
  const double whole_s = least_cpu_s(2, [&] { decompose(x); }) / double(x.size());
  const double start_s = least_cpu_s(10, [&] { decompose(start); }) / double(start.size());
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
