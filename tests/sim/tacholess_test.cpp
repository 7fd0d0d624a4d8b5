#include <catch2/catch.hpp>

#include "analysis/order/line_phase.hpp"
#include "sim/rv_bench.hpp"

using namespace rvbench;

namespace {

struct Heard {
  Eigen::MatrixXd accelerations_m_s2;  // a column for each channel
  Eigen::VectorXd turns;               // of the input shaft, as its encoder counts
};

Heard listen(const std::string& preset, double supply_Hz, int seconds) {
  constexpr int rate = static_cast<int>(sim::RvBench::rate_Hz);
  sim::RvBench bench(sim::draw_unit(preset, 1));
  bench.set_supply(supply_Hz, true);
  bench.set_brake_torque(83.5);
  Eigen::VectorXf scan(sim::RvBench::sensors);
  for (int i = 0; i < 3 * rate; ++i) bench.step(scan);
  Heard heard{Eigen::MatrixXd(seconds * rate, sim::RvBench::sensors),
              Eigen::VectorXd(seconds * rate)};
  for (int i = 0; i < seconds * rate; ++i) {
    bench.step(scan);
    heard.accelerations_m_s2.row(i) = scan.cast<double>();
    heard.turns[i] = bench.train().input_angle_rad() / (2 * std::numbers::pi);
  }
  return heard;
}

}  // namespace

// The cranks carry the 1560th line of 121 turns with them: in the housing it is 1521 and 1599, each
// alone for 39/121 orders around. The sun's mesh, 1080, is 1079 and 1081 there: too near to each
// other to be followed in so short a record.
TEST_CASE("the vibration of the reducer tells the encoder's speed", "[sim][order]") {
  const auto [preset, supply_Hz] =
      GENERATE(table<std::string, double>({{"healthy", 40}, {"input_shaft", 60}}));
  CAPTURE(preset, supply_Hz);
  const Heard heard = listen(preset, supply_Hz, 10);
  const double rate_Hz = sim::RvBench::rate_Hz;
  const double nominal_Hz = supply_Hz / 2;  // two pole pairs; slip is what is not known
  int told = 0;
  for (Eigen::Index channel = 0; channel < heard.accelerations_m_s2.cols(); ++channel) {
    for (const double order : {1521.0 / 121, 1599.0 / 121}) {
      CAPTURE(channel, order);
      const Eigen::VectorXd x = heard.accelerations_m_s2.col(channel);
      const auto ridge = analysis::line_ridge(x, rate_Hz,
                                              {.from_Hz = (order - 0.3) * nominal_Hz,
                                               .to_Hz = (order + 0.15) * nominal_Hz,
                                               .block_s = 2.5,
                                               .most_change_Hz_s = 0.5});
      if (!ridge) continue;
      const auto line = analysis::line_phase(x, rate_Hz, *ridge, 6);
      if (!line) continue;
      const Eigen::Index from = line->settling, turns = heard.turns.size() - 1 - 2 * from;
      const double encoder_Hz =
          (heard.turns[from + turns] - heard.turns[from]) * rate_Hz / double(turns);
      CHECK(line->mean_frequency_Hz() / order == Approx(encoder_Hz).epsilon(5e-4));
      ++told;
    }
  }
  CHECK(told >= 12);  // of 24: the others are too weak, and say so
}
