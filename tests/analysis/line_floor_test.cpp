#include "analysis/line_floor.hpp"

#include "analysis/hilbert.hpp"
#include "analysis/statistics.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::amplitude_spectrum;
using analysis::line_floor;
using analysis::line_p_value;
using analysis::LineFloor;
using analysis::Window;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::UniformBelow;

namespace {

LineFloor floor_of(const Eigen::VectorXd& x, Eigen::Index locked_every = 0) {
  return line_floor(amplitude_spectrum(x, 1000, Window::hann), locked_every);
}

// p-values of lines so far apart that they are independent, over some draws of noise.
template <class Noise>
test::NullDraws p_values_of(Noise noise, int draws, Eigen::Index locked_every = 0) {
  test::NullDraws draws_of_noise;
  for (int seed = 1; seed <= draws; ++seed) {
    const LineFloor lines = floor_of(noise(static_cast<unsigned>(seed)), locked_every);
    for (Eigen::Index i = 200; i + 200 < lines.power.size(); i += 7) {
      draws_of_noise.p_values.push_back(
          line_p_value(lines.power[i] / lines.floor[i], 1, lines.floor_lines[i]));
    }
  }
  return draws_of_noise;
}

}  // namespace

TEST_CASE("the floor of white noise is the mean power of its lines", "[analysis][floor]") {
  // Hann lines of white noise of variance 1 have the mean power 4/n · 3/2.
  const Eigen::Index n = 40000;
  const LineFloor lines = floor_of(test::white_noise(n, 1));
  const double mean = lines.floor.segment(200, n / 2 - 400).mean();
  CHECK(mean == Approx(6.0 / static_cast<double>(n)).epsilon(0.02));
  CHECK((lines.floor.array() > 0).all());
}

TEST_CASE("p-values of noise lines over their floor are uniform", "[analysis][floor][null]") {
  const auto white = [](unsigned seed) { return test::white_noise(16000, seed); };
  CHECK_THAT(p_values_of(white, 40), UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
}

TEST_CASE("leaving lines out for the gear train keeps p-values uniform",
          "[analysis][floor][null]") {
  const auto white = [](unsigned seed) { return test::white_noise(16000, seed); };
  const auto locked_every = GENERATE(Eigen::Index{12}, Eigen::Index{100});
  CAPTURE(locked_every);
  CHECK_THAT(p_values_of(white, 40, locked_every), UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
}

TEST_CASE("of the few lines between dense multiples p-values err to the safe side",
          "[analysis][floor][null]") {
  // One line in four is left, and those are independent: the floor is worth more than it says.
  const auto white = [](unsigned seed) { return test::white_noise(16000, seed); };
  CHECK_THAT(p_values_of(white, 40, 4), NoOftenerThanStated({0.001, 0.01, 0.1, 0.5, 0.9}));
}

TEST_CASE("the floor follows the colour of noise", "[analysis][floor][null]") {
  SECTION("that falls with frequency") {
    const auto red = [](unsigned seed) {
      return test::reddened(test::white_noise(16000, seed), 0.9);
    };
    CHECK_THAT(p_values_of(red, 40), UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
  }
  SECTION("that rings at 5 % of damping") {
    const auto ringing = [](unsigned seed) {
      return test::resonant(test::white_noise(16000, seed), 0.2, 0.05);
    };
    CHECK_THAT(p_values_of(ringing, 40), UniformBelow({0.001, 0.01, 0.1, 0.5, 0.9}));
  }
}

TEST_CASE("the floor follows an envelope's noise down to its lowest lines",
          "[analysis][floor][null]") {
  // A mode 100 lines wide, as EMD leaves it: the noise of its envelope ends after as many.
  const auto narrow = [](unsigned seed) {
    const Eigen::VectorXd mode = test::resonant(test::white_noise(16000, seed), 0.01, 0.3);
    return analysis::envelope(mode);
  };
  NullDraws lowest;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const LineFloor lines = floor_of(narrow(seed));
    lowest.p_values.push_back(
        line_p_value(lines.power[32] / lines.floor[32], 1, lines.floor_lines[32]));
  }
  CHECK_THAT(lowest, NoOftenerThanStated({0.001, 0.01, 0.1}));
}

TEST_CASE("a line, and a comb of lines, stand on the floor and do not lift it",
          "[analysis][floor]") {
  const Eigen::Index n = 16000;
  const Eigen::VectorXd noise = test::white_noise(n, 5);
  const LineFloor alone = floor_of(noise, 16);
  Eigen::VectorXd comb = noise;
  // On every multiple of 16 lines, 40 dB above the floor.
  for (Eigen::Index line = 16; line < n / 2; line += 16) {
    comb += 2 * test::tone(static_cast<double>(line) * 1000 / static_cast<double>(n), n, 1000,
                           static_cast<double>(line));
  }
  const LineFloor with = floor_of(comb, 16);
  CHECK((with.floor - alone.floor).cwiseAbs().maxCoeff() < 1e-3 * alone.floor.mean());
  CHECK(with.power[16 * 50] == Approx(4).epsilon(0.05));
}

TEST_CASE("lines on and beside a multiple are locked, except where multiples are everywhere",
          "[analysis][floor]") {
  const LineFloor sparse = floor_of(test::white_noise(1000, 1), 100);
  CHECK(sparse.is_locked(300));
  CHECK(sparse.is_locked(299));
  CHECK(sparse.is_locked(301));
  CHECK_FALSE(sparse.is_locked(350));
  const LineFloor dense = floor_of(test::white_noise(1000, 1), 4);
  CHECK_FALSE(dense.is_locked(300));
  CHECK_FALSE(floor_of(test::white_noise(1000, 1)).is_locked(300));
}

TEST_CASE("silence has a floor above zero", "[analysis][floor]") {
  const LineFloor lines = floor_of(Eigen::VectorXd::Zero(1000));
  CHECK((lines.floor.array() > 0).all());
  CHECK((lines.power.array() / lines.floor.array()).maxCoeff() == 0);
}
