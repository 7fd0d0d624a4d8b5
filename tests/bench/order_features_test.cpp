#include "bench/order_features.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

using namespace rvbench;
using bench::OrderFeature;
using Complex = std::complex<double>;

namespace {

// A reducer of 121 whose input turns at 1815 rpm: order 240 of its period is at 60 Hz.
sim::SteadyState turning() {
  sim::SteadyState state;
  state.period_Hz = 1815.0 / 60 / 121;
  state.rhythms_Hz = {50};
  sim::SteadyOutput torque;
  torque.mean = 1.5;
  torque.shaft_lines = Eigen::VectorXcd::Zero(300);
  torque.shaft_lines[240] = Complex(0.3, 0.4);
  torque.timed_lines = Eigen::VectorXcd::Constant(1, Complex(0, 0.1));
  state.outputs = {torque};
  return state;
}

OrderFeature at_Hz(double frequency_Hz) { return {analysis::LockedTo::time, 0, 0, frequency_Hz}; }

}  // namespace

TEST_CASE("a line that follows time is what keeps its frequency", "[bench][orders]") {
  CHECK(predicted(turning(), at_Hz(50), 0.04) == Complex(0, 0.1));
  CHECK(predicted(turning(), at_Hz(50.03), 0.04) == Complex(0, 0.1));
  CHECK(predicted(turning(), at_Hz(50.1), 0.04) == Complex(0, 0));
}

TEST_CASE("a line of the shaft that has the mains frequency is seen there", "[bench][orders]") {
  CHECK(std::abs(predicted(turning(), at_Hz(60), 0.04)) == Approx(0.5));
  CHECK(std::abs(predicted(turning(), at_Hz(60.1), 0.04)) == 0);
  CHECK(std::abs(predicted(turning(), at_Hz(1000), 0.04)) == 0);  // above what is solved
}
