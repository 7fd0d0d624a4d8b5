#include "sim/hammer_tap.hpp"

#include <catch2/catch.hpp>

#include "sim/rv_bench.hpp"

namespace rvbench::sim {

TEST_CASE("a tap is a half sine whose impulse is 2/pi of peak times width", "[sim]") {
  HammerTap tap(1e6);
  CHECK(tap.step() == 0);  // nobody taps
  tap.strike();
  double impulse_Ns = 0, peak_N = 0;
  while (!tap.is_over()) {
    const double force_N = tap.step();
    impulse_Ns += force_N / 1e6;
    peak_N = std::max(peak_N, force_N);
  }
  CHECK(peak_N == Approx(HammerTap::peak_N));
  CHECK(impulse_Ns == Approx(0.6366198 * HammerTap::peak_N * HammerTap::width_s));
}

TEST_CASE("a tap on the housing is felt by every accelerometer, rings and dies out", "[sim]") {
  RvBench bench(draw_unit("healthy", 1));
  Eigen::VectorXf scan(RvBench::sensors);
  const auto largest = [&](double duration_s) {
    Eigen::ArrayXf most = Eigen::ArrayXf::Zero(RvBench::sensors);
    for (int i = 0; i < static_cast<int>(duration_s * RvBench::rate_Hz); ++i) {
      bench.step(scan);
      most = most.max(scan.array().abs());
    }
    return most;
  };
  const Eigen::ArrayXf before = largest(0.5);
  CHECK(before.maxCoeff() < 0.2F);
  bench.tap_housing();
  CHECK((largest(0.1) > 1).all());
  (void)largest(0.5);
  CHECK(largest(0.5).maxCoeff() < 1.5F * before.maxCoeff());
}

}  // namespace rvbench::sim
