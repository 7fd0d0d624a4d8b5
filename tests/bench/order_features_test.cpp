#include "bench/order_features.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>

using namespace rvbench;
using bench::OrderFeature;
using Complex = std::complex<double>;

namespace {

constexpr double record_s = 50;

// A reducer of 121 whose input turns at 1815 rpm: order 240 of its period is at 60 Hz.
sim::SteadyState turning() {
  sim::SteadyState state;
  state.period_Hz = 1815.0 / 60 / 121;
  state.rhythms_Hz = {50};
  state.slip_of = {""};
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

// A Hann window's main lobe: 1 on the line, 0.849 half a line beside it, 0.5 on the next, then
// none.
TEST_CASE("a line that follows time is what keeps its frequency, as a Hann window shows it",
          "[bench][orders]") {
  const auto shown = [](double frequency_Hz) {
    return std::abs(predicted(turning(), at_Hz(frequency_Hz), record_s));
  };
  CHECK(predicted(turning(), at_Hz(50), record_s) == Complex(0, 0.1));
  CHECK(shown(50.01) == Approx(0.1 * 0.8488).epsilon(1e-3));
  CHECK(shown(49.98) == Approx(0.05));
  CHECK(shown(50.041) == 0);
}

TEST_CASE("a line of a motor's slip is compared with the plant's own, whose slip is another",
          "[bench][orders]") {
  sim::SteadyState state = turning();
  state.rhythms_Hz = {1.9};
  state.slip_of = {"motor"};
  OrderFeature measured = at_Hz(1.6);
  CHECK(predicted(state, measured, record_s) == Complex(0));
  measured.slip_of = "motor";
  CHECK(predicted(state, measured, record_s) == Complex(0, 0.1));
  measured.slip_of = "another motor";
  CHECK(predicted(state, measured, record_s) == Complex(0));
  measured.slip_of = "motor";
  state.slip_of = {""};
  CHECK(predicted(state, measured, record_s) == Complex(0));
}

TEST_CASE("a line of the shaft that has the mains frequency is seen there", "[bench][orders]") {
  CHECK(std::abs(predicted(turning(), at_Hz(60), record_s)) == Approx(0.5));
  CHECK(std::abs(predicted(turning(), at_Hz(60.02), record_s)) == Approx(0.25));
  CHECK(std::abs(predicted(turning(), at_Hz(60.1), record_s)) == 0);
  CHECK(std::abs(predicted(turning(), at_Hz(1000), record_s)) == 0);  // above what is solved
}
