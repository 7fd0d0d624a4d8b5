#include "analysis/compare/channel_levels.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/compare/record_levels.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/spall.hpp"
#include "tests/support/under_sanitizer.hpp"

// How high lines stand where there is noise alone.
namespace rvbench::analysis {
namespace {

// A train that repeats every so many turns, beside a part that slips.
Kinematics train_with_bearing(double period_turns) {
  Kinematics k;
  k.machine = "train";
  k.period_turns = period_turns;
  k.orders = {{"input shaft", 1, {}, "input_shaft", ""}};
  k.signatures = {test::spall_of("bearing_outer", 3.585, 4)};
  return k;
}

test::NullDraws lines_of_noise(const Kinematics& kinematics, Eigen::Index count, unsigned draws) {
  const std::vector<Quantity> quantities = quantities_to_compare(kinematics);
  test::NullDraws lines;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const test::OrderSignals signals{.count = count};
    const RecordLevels levels =
        measure_levels(signals.recording(signals.noise(seed)), kinematics, quantities);
    for (std::size_t q = 0; q < quantities.size(); ++q) {
      if (!quantities[q].is_in(0)) continue;
      lines.p_values.push_back(levels.channels.front().levels[q].p_value);
    }
  }
  return lines;
}

}  // namespace

TEST_CASE("noise shows no lines of a part that slips, whatever was taken out with the train",
          "[analysis][null]") {
  // Periods in the record: 4 and more; one of 30 turns has each fourth line.
  const double period_turns = GENERATE(1.0, 3.0, 16.0, 30.0);
  CAPTURE(period_turns);
  const unsigned draws = test::under_sanitizer ? 2 : 150;
  const test::NullDraws lines =
      lines_of_noise(train_with_bearing(period_turns), 13000, draws);  // 130 turns
  REQUIRE(lines.p_values.size() >= 4 * draws);
  if (test::under_sanitizer) return;
  CHECK_THAT(lines, test::NoOftenerThanStated({0.001, 0.01, 0.05}));
}

}  // namespace rvbench::analysis
