#include "analysis/explain/period_lines.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace rvbench;

namespace {

constexpr double two_pi = 2 * std::numbers::pi;
constexpr double rate_Hz = 500, length_s = 20;

struct Wave {
  double amplitude, frequency_Hz;
};

Channel signal_of(const std::vector<Wave>& waves) {
  const auto count = static_cast<Eigen::Index>(rate_Hz * length_s);
  const Eigen::VectorXd t_s = Eigen::VectorXd::LinSpaced(count, 0, double(count - 1) / rate_Hz);
  Eigen::VectorXd sum = Eigen::VectorXd::Constant(count, 0.7);
  for (const auto& [amplitude, frequency_Hz] : waves) {
    sum.array() += amplitude * (two_pi * frequency_Hz * t_s.array() + 0.4).cos();
  }
  return {{"torque", "N·m", "", not_known}, rate_Hz, 0, sum};
}

}  // namespace

SCENARIO("a line that is taken out leaves others as they are", "[analysis][explain]") {
  const double lines_apart = GENERATE(4.0, 4.5, 9.0);  // of 1/length
  const double strong_Hz = 50.013, weak_Hz = strong_Hz + lines_apart / length_s;
  Channel signal = signal_of({{1, strong_Hz}, {1e-3, weak_Hz}});
  analysis::take_out_line(signal, strong_Hz);
  CHECK(analysis::line_at(signal, strong_Hz).amplitude < 1e-5);
  CHECK(analysis::line_at(signal, weak_Hz).amplitude == Approx(1e-3).epsilon(1e-3));
  CHECK(signal.samples.mean() == Approx(0.7).epsilon(1e-3));
}

TEST_CASE("where there is no line, hardly any noise is taken out", "[analysis][explain]") {
  Channel signal = signal_of({{0.2, 31}});
  const Eigen::VectorXd before = signal.samples;
  analysis::take_out_line(signal, 50);
  CHECK((signal.samples - before).cwiseAbs().maxCoeff() < 1e-5);
}

// A shaft of 10 turns/s whose machine repeats after 11 turns, and a cage of 0.4 of its speed.
TEST_CASE("what turns with the machine but does not repeat with it shows between its orders",
          "[analysis][explain]") {
  Channel torque = signal_of({{0.5, 10}, {0.01, 10 * 4.45 / 11}});
  Channel angle = torque;
  angle.info = {"input_angle", "rad", "", not_known};
  for (Eigen::Index i = 0; i < angle.samples.size(); ++i) {
    angle.samples[i] = two_pi * 10 * double(i) / rate_Hz;
  }
  Recording record;
  record.channels = {torque, angle};
  const auto shaft = analysis::ShaftAngle::of(record);
  REQUIRE(shaft);
  const auto lines = analysis::period_lines(torque, *shaft, 11);
  REQUIRE(lines);
  CHECK(lines->amplitude[11] == Approx(0.5).epsilon(1e-3));
  CHECK(lines->between[4] > 0.0085);  // half a line beside it, a Hann window passes 0.85
  CHECK(lines->between[4] < 0.0101);
  for (const Eigen::Index k : {0, 1, 7, 9, 10, 11, 12, 15, 40}) {
    INFO("order " << double(k) + 0.5);
    CHECK(lines->between[k] < 2e-4);
  }
}
