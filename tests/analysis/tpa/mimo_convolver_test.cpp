#include "analysis/tpa/mimo_convolver.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "tests/support/signals.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

FirMatrix random_filters(Index outputs, Index inputs, Index taps) {
  return {.outputs = outputs,
          .inputs = inputs,
          .rate_Hz = 4960,
          .delay_samples = 0,
          .taps = test::white_noise(taps * outputs * inputs, 1).reshaped(taps, outputs * inputs)};
}

Eigen::MatrixXd noise(Index samples, Index channels) {
  return test::white_noise(samples * channels, 2).reshaped(samples, channels);
}

/// The sum over inputs and taps as it is written.
Eigen::MatrixXd direct(const FirMatrix& filters, const Eigen::MatrixXd& in) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(in.rows(), filters.outputs);
  for (Index output = 0; output < filters.outputs; ++output) {
    for (Index input = 0; input < filters.inputs; ++input) {
      const Eigen::VectorXd h = filters.response(output, input);
      for (Index tap = 0; tap < std::min(h.size(), in.rows()); ++tap) {
        const Index count = in.rows() - tap;
        out.col(output).tail(count) += h[tap] * in.col(input).head(count);
      }
    }
  }
  return out;
}

/// What comes out of pushes of `block` samples, one after the other.
Eigen::MatrixXd streamed(MimoConvolver& convolver, const Eigen::MatrixXd& in, Index outputs,
                         Index block) {
  Eigen::MatrixXd all(0, outputs);
  for (Index from = 0; from < in.rows(); from += block) {
    const Index count = std::min(block, in.rows() - from);
    Eigen::MatrixXd out(convolver.ready_after(count), outputs);
    const Index ready = convolver.push(in.middleRows(from, count), out);
    REQUIRE(ready == out.rows());
    all.conservativeResize(all.rows() + ready, Eigen::NoChange);
    all.bottomRows(ready) = out;
  }
  return all;
}

double difference(const Eigen::MatrixXd& all, const Eigen::MatrixXd& expected) {
  const Eigen::MatrixXd known = expected.topRows(all.rows());
  return (all - known).cwiseAbs().maxCoeff() / known.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("a stream is convolved as by the sum, however it is cut and comes", "[analysis][tpa]") {
  const auto [outputs, inputs] = GENERATE(table<Index, Index>({{1, 1}, {3, 5}, {4, 2}}));
  const auto settings = GENERATE(ConvolverSettings{16, 1}, ConvolverSettings{7, 3},
                                 ConvolverSettings{100, 2}, ConvolverSettings{250, 4});
  const Index block = GENERATE(1, 13, 1200);
  CAPTURE(outputs, inputs, settings.partition_samples, settings.partitions_per_pass, block);
  const FirMatrix filters = random_filters(outputs, inputs, 100);
  const Eigen::MatrixXd in = noise(1200, inputs);
  MimoConvolver convolver(filters, settings);
  const Eigen::MatrixXd all = streamed(convolver, in, outputs, block);
  CHECK(all.rows() > in.rows() - convolver.latency_samples());
  CHECK(difference(all, direct(filters, in)) < 1e-13);
}

TEST_CASE("36 indicators make 18 forces, and these three targets, to 1e-12 of direct sums",
          "[analysis][tpa]") {
  constexpr Index taps = 96;
  const FirMatrix forces = random_filters(18, 36, taps), targets = random_filters(3, 18, taps);
  const auto settings =
      GENERATE(ConvolverSettings::low_latency(), ConvolverSettings{3 * 96 + 1, 2});
  const Eigen::MatrixXd in = noise(4 * 289, 36);
  MimoConvolver to_forces(forces, settings), to_targets(targets, settings);
  const Eigen::MatrixXd force = streamed(to_forces, in, 18, 500);
  const Eigen::MatrixXd target = streamed(to_targets, force, 3, force.rows());
  const Eigen::MatrixXd expected = direct(forces, in);
  CHECK(force.rows() > 0);
  CHECK(target.rows() == force.rows());  // a chain waits once: blocks fit each other
  CHECK(difference(force, expected) < 1e-12);
  CHECK(difference(target, direct(targets, expected)) < 1e-12);
}

TEST_CASE("a result is there when its block is full, and not before", "[analysis][tpa]") {
  const FirMatrix filters = random_filters(2, 2, 2048);
  MimoConvolver convolver(filters, ConvolverSettings::low_latency());
  CHECK(convolver.latency_samples() == 128);
  CHECK(1e3 * double(convolver.latency_samples()) / filters.rate_Hz < 50);  // ms
  Eigen::MatrixXd out(128, 2);
  CHECK(convolver.ready_after(127) == 0);
  CHECK(convolver.push(noise(127, 2), out) == 0);
  CHECK(convolver.push(noise(0, 2), out) == 0);
  CHECK(convolver.push(noise(1, 2), out) == 128);
  CHECK(MimoConvolver(filters, ConvolverSettings::throughput(2048)).latency_samples() == 8 * 14337);
}

TEST_CASE("silence in is silence out, and a single sample the filter itself", "[analysis][tpa]") {
  const FirMatrix filters = random_filters(2, 3, 50);
  MimoConvolver convolver(filters, {20, 1});
  Eigen::MatrixXd out(200, 2);
  convolver.push(Eigen::MatrixXd::Zero(200, 3), out);
  CHECK(out.isZero(0));
  Eigen::MatrixXd struck = Eigen::MatrixXd::Zero(200, 3);
  struck(0, 1) = 1;
  convolver.push(struck, out);
  CHECK((out.col(1).head(50) - filters.response(1, 1)).cwiseAbs().maxCoeff() < 1e-14);
  CHECK(out.bottomRows(150).cwiseAbs().maxCoeff() < 1e-14);
}

TEST_CASE("every processor convolves alike", "[analysis][tpa][law]") {
  const FirMatrix filters = random_filters(5, 7, 300);
  const Eigen::MatrixXd in = noise(2000, 7);
  const ConvolverSettings settings{64, 3};
  MimoConvolver best(filters, settings), portable(filters, settings, portable_mac_kernels());
  const Eigen::MatrixXd a = streamed(best, in, 5, 100), b = streamed(portable, in, 5, 100);
  CHECK((a - b).cwiseAbs().maxCoeff() < 1e-13 * a.cwiseAbs().maxCoeff());
}

TEST_CASE("a sample that is not finite spoils what its filters reach, and no more",
          "[analysis][tpa]") {
  const FirMatrix filters = random_filters(1, 1, 50);
  MimoConvolver convolver(filters, {32, 1});
  Eigen::MatrixXd in = noise(320, 1);
  in(40, 0) = std::numeric_limits<double>::quiet_NaN();
  Eigen::MatrixXd out(320, 1);
  convolver.push(in, out);
  CHECK(out.topRows(32).allFinite());
  CHECK_FALSE(out.middleRows(32, 32).allFinite());
  CHECK(out.bottomRows(160).allFinite());
}

TEST_CASE("filters and blocks that do not fit are refused", "[analysis][tpa]") {
  FirMatrix filters = random_filters(2, 3, 10);
  CHECK_THROWS_AS(MimoConvolver(filters, {0, 1}), std::invalid_argument);
  CHECK_THROWS_AS(MimoConvolver(filters, {8, 0}), std::invalid_argument);
  MimoConvolver convolver(filters, {8, 1});
  Eigen::MatrixXd out(8, 2);
  CHECK_THROWS_AS(convolver.push(noise(8, 2), out), std::invalid_argument);
  CHECK_THROWS_AS(convolver.push(noise(17, 3), out), std::invalid_argument);
  filters.taps(3, 1) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(MimoConvolver(filters, {8, 1}), std::invalid_argument);
}
