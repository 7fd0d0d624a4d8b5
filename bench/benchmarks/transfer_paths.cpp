#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <Eigen/SVD>
#include <random>

#include "analysis/tpa/mimo_convolver.hpp"
#include "analysis/tpa/regularised_inverse.hpp"
#include "bench/benchmarks/bare_fftw.hpp"

namespace {

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

constexpr Index indicators = 36, paths = 18, targets = 3, lines = 2048, modes = 40, taps = 2048;
constexpr double rate_Hz = 4960;

Eigen::MatrixXd noise(Index rows, Index columns, std::mt19937& generator) {
  std::normal_distribution<double> gaussian;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return gaussian(generator); });
}

// 40 modes between 15 and 2400 Hz, six paths that nearly depend on six others, 0.1 % of noise:
// conditions of a thousand and more.
LineMatrices modal_frfs() {
  std::mt19937 generator(77);
  std::uniform_real_distribution<double> mode_Hz(15, 2400), damping(0.01, 0.04);
  const Eigen::MatrixXd heard = noise(indicators, modes, generator);
  Eigen::MatrixXd struck = noise(paths, modes, generator);
  struck.bottomRows(6) = struck.topRows(6) + 0.03 * struck.bottomRows(6);
  LineMatrices frfs(indicators, paths, lines);
  for (Index mode = 0; mode < modes; ++mode) {
    const double natural = mode_Hz(generator), zeta = damping(generator);
    const Eigen::MatrixXcd shape =
        (heard.col(mode) * struck.col(mode).transpose()).cast<std::complex<double>>();
    for (Index line = 0; line < lines; ++line) {
      const double f = double(line + 1) * rate_Hz / (2 * lines);
      const std::complex<double> stiffness(natural * natural - f * f, 2 * zeta * natural * f);
      frfs[line] += -f * f / stiffness * shape;
    }
  }
  const double level = 1e-3 * frfs.values.cwiseAbs().mean();
  frfs.values.real() += level * noise(frfs.values.size(), 1, generator);
  frfs.values.imag() += level * noise(frfs.values.size(), 1, generator);
  return frfs;
}

RegularisedInverse truncated(const LineMatrices& frfs) {
  return regularised_inverse(line_svd(frfs, 1),
                             std::vector<Regularisation>(std::size_t(lines), {.kept = 12}), 1);
}

// By Eigen's divide and conquer, of every 16th line.
LineMatrices truncated_by_eigen(const LineMatrices& frfs) {
  LineMatrices inverse(paths, indicators, lines / 16);
  for (Index i = 0; i < inverse.lines; ++i) {
    const Eigen::BDCSVD<Eigen::MatrixXcd> svd(frfs[16 * i],
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
    inverse[i] = svd.matrixV().leftCols(12) *
                 svd.singularValues().head(12).cwiseInverse().asDiagonal() *
                 svd.matrixU().leftCols(12).adjoint();
  }
  return inverse;
}

// The stand-in for LAPACK's zgesdd, which no package needed here brings: OpenBLAS's took a third of
// what BDCSVD did, compiled for SSE2 as here (AMD Zen 3). The limit is 0.6 of that.
void truncated_inverse(benchmark::State& state) {
  const LineMatrices frfs = modal_frfs();
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(truncated(frfs));
  const RegularisedInverse ours = truncated(frfs);
  const LineMatrices eigens = truncated_by_eigen(frfs);
  double error = 0;
  for (Index i = 0; i < eigens.lines; ++i) {
    error = std::max(error, (ours.values[16 * i] - eigens[i]).norm() / eigens[i].norm());
  }
  const double ours_s = bench::least_cpu_s(5, [&] { benchmark::DoNotOptimize(truncated(frfs)); });
  const double eigens_s =
      16 * bench::least_cpu_s(3, [&] { benchmark::DoNotOptimize(truncated_by_eigen(frfs)); });
  state.SetLabel(fmt::format(
      "2048 lines of 36 x 18, 12 kept: {:.3f} s, {:.2f} of what Eigen's BDCSVD takes, limit 0.2; "
      "relative difference {:.0e}, limit 1e-10",
      ours_s, ours_s / eigens_s, error));
}
BENCHMARK(truncated_inverse)->Unit(benchmark::kSecond);

FirMatrix filters(Index outputs, Index inputs) {
  std::mt19937 generator(5);
  FirMatrix made{outputs, inputs, rate_Hz, 0, noise(taps, outputs * inputs, generator)};
  const Eigen::ArrayXd decay = Eigen::ArrayXd::LinSpaced(taps, 0, -double(taps - 1) / 400).exp();
  made.taps.array().colwise() *= decay;
  return made;
}

// Indicators to forces to targets, in steps of a second, as they come.
void stream(benchmark::State& state, const ConvolverSettings& settings, double duration_s,
            const std::string& limit) {
  std::mt19937 generator(3);
  const Eigen::MatrixXd second = noise(Index(rate_Hz), indicators, generator);
  MimoConvolver to_forces(filters(paths, indicators), settings);
  MimoConvolver to_targets(filters(targets, paths), settings);
  const Index most = second.rows() + to_forces.latency_samples();
  Eigen::MatrixXd force(most, paths), target(most, targets);
  const auto run = [&] {
    for (double t_s = 0; t_s < duration_s; ++t_s) {
      const Index ready = to_forces.push(second, force);
      benchmark::DoNotOptimize(to_targets.push(force.topRows(ready), target));
    }
  };
  for ([[maybe_unused]] auto _ : state) run();
  state.SetLabel(
      fmt::format("36 -> 18 -> 3 channels, 2048 taps, 4960 Hz: {:.0f}x real time{}; "
                  "results after {:.0f} ms",
                  duration_s / bench::least_cpu_s(5, run), limit,
                  1e3 * double(to_forces.latency_samples()) / rate_Hz));
}

void streamed_at_most_throughput(benchmark::State& state) {
  stream(state, ConvolverSettings::throughput(taps), 60, ", limit 250x");
}
BENCHMARK(streamed_at_most_throughput)->Unit(benchmark::kSecond);

void streamed_at_low_latency(benchmark::State& state) {
  stream(state, ConvolverSettings::low_latency(), 10, ", limit 1x; within 50 ms");
}
BENCHMARK(streamed_at_low_latency)->Unit(benchmark::kSecond);

}  // namespace
