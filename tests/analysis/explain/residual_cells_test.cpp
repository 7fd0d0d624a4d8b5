#include "analysis/explain/residual_cells.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace rvbench::analysis;

namespace {

constexpr int conditions = 9, lines = 60;

// Sixty orders and a mean of two channels under nine conditions, off by noise alone.
std::vector<ResidualCell> noise(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<ResidualCell> cells;
  for (const char* channel : {"input_torque", "accel_1x"}) {
    for (int c = 0; c < conditions; ++c) {
      const std::string condition = "condition " + std::to_string(c);
      for (int k = 0; k <= lines; ++k) {
        cells.push_back({channel, "N·m", condition, k > 0 ? LockedTo::shaft : LockedTo::nothing,
                         k / 121.0, 0.01 * normal(engine), 0.01});
      }
    }
  }
  return cells;
}

}  // namespace

TEST_CASE("of fifteen p-values the four smallest are discoveries",
          "[analysis][explain][literature]") {
  // The example of Benjamini & Hochberg (1995), section 4.
  const std::vector<double> p{0.0001, 0.0004, 0.0019, 0.0095, 0.0201, 0.0278, 0.0298, 0.0344,
                              0.0459, 0.3240, 0.4262, 0.5719, 0.6528, 0.7590, 1.000};
  const std::vector<bool> found = discoveries(p, 0.05);
  CHECK(std::ranges::count(found, true) == 4);
  CHECK((found[0] && found[1] && found[2] && found[3]));
  std::vector<double> reversed(p.rbegin(), p.rend());
  CHECK(discoveries(reversed, 0.05).back());
  CHECK(discoveries({}, 0.05).empty());
}

TEST_CASE("noise is off nowhere, but once in twenty times", "[analysis][explain][locate]") {
  int false_alarms = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    if (!locate(noise(seed), 1.5 / 121).empty()) ++false_alarms;
  }
  CHECK(false_alarms <= 18);  // 10 expected; 18 and more have a probability of 1 %
}

TEST_CASE("what is off is gathered by where it is, over the conditions where it is",
          "[analysis][explain][locate]") {
  std::vector<ResidualCell> cells = noise(7);
  for (ResidualCell& cell : cells) {
    const bool is_line = cell.locked_to == LockedTo::shaft && cell.channel == "input_torque";
    const int order = static_cast<int>(std::round(cell.place * 121));
    const bool is_shown = cell.condition == "condition 2" || cell.condition == "condition 5";
    if (is_line && is_shown && (order == 39 || order == 40)) cell.apart -= 0.15;
    if (is_line && cell.condition == "condition 5" && order == 12) cell.apart += 0.3;
  }
  const auto found = locate(cells, 1.5 / 121);
  REQUIRE(found.size() == 2);
  CHECK(found[0].channel == "input_torque");
  CHECK(found[0].locked_to == LockedTo::shaft);
  CHECK(found[0].first == Approx(12 / 121.0));
  CHECK(found[0].last == found[0].first);
  CHECK(found[0].conditions == std::vector<std::string>{"condition 5"});
  CHECK(found[0].apart == Approx(0.3).margin(0.05));
  CHECK(found[0].standard_errors == Approx(30).margin(5));
  CHECK(found[1].first == Approx(39 / 121.0));
  CHECK(found[1].last == Approx(40 / 121.0));
  CHECK(found[1].conditions.size() == 2);
  CHECK(found[1].standard_errors < -10);
  CHECK(found[1].together == Approx(15 * std::sqrt(2)).epsilon(0.3));  // of two conditions
}

TEST_CASE("a cluster is new where the plant shows none of its lines",
          "[analysis][explain][locate]") {
  std::vector<ResidualCell> cells;
  for (int i = 0; i < conditions; ++i) {
    const double off = i == 3 || i == 4 || i == 8 || i == 9 ? 0.2 : 0;
    cells.push_back({"torque", "N·m", "usual", LockedTo::shaft, i + 1.0, off, 0.01});
    cells.back().is_new = i != 4;
  }
  const auto found = locate(cells, 1.5);
  REQUIRE(found.size() == 2);
  for (const auto& cluster : found) CHECK(cluster.is_new == (cluster.first > 5));
}

TEST_CASE("times of two programmes are two places", "[analysis][explain][locate]") {
  std::vector<ResidualCell> cells;
  for (const char* programme : {"slow", "fast"}) {
    for (int i = 0; i < conditions; ++i) {
      cells.push_back({"force", "N", programme, LockedTo::programme, 0.25 * i, 0, 0.01});
    }
  }
  cells[2].apart = 0.2;                 // slow, 0.5 s
  cells[conditions + 3].apart = -0.15;  // fast, 0.75 s
  const auto found = locate(cells, 0.375);
  REQUIRE(found.size() == 2);
  CHECK(found[0].conditions == std::vector<std::string>{"slow"});
  CHECK(found[0].first == 0.5);
  CHECK(found[1].conditions == std::vector<std::string>{"fast"});
  CHECK(found[1].first == 0.75);
}
