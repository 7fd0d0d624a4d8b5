#include "analysis/compare/matched_points.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <utility>

namespace rvbench::analysis {
namespace {

std::vector<RecordLevels> at(const std::vector<std::pair<double, double>>& places) {
  std::vector<RecordLevels> records;
  for (const auto& [speed_rpm, load_pct] : places) {
    RecordLevels record;
    record.speed_rpm = speed_rpm;
    record.load_pct = load_pct;
    record.channels.resize(1);
    records.push_back(record);
  }
  return records;
}

}  // namespace

TEST_CASE("repeats of a point are found wherever they are in the list", "[analysis]") {
  const auto points = points_of(at({{1815, 100}, {605, 0}, {1815, 100}, {605, 100}, {605, 0}}));
  REQUIRE(points.size() == 3);
  CHECK(points[0].records == std::vector<std::size_t>{1, 4});
  CHECK(points[1].records == std::vector<std::size_t>{3});
  CHECK(points[2].records == std::vector<std::size_t>{0, 2});
}

TEST_CASE("speeds that drift apart make the same points in whatever order they come",
          "[analysis]") {
  // Each is within a percent of the next, the first and the last are not.
  const auto rising = points_of(at({{1000, 50}, {1008, 50}, {1016, 50}}));
  const auto mixed = points_of(at({{1008, 50}, {1016, 50}, {1000, 50}}));
  REQUIRE(rising.size() == 2);
  REQUIRE(mixed.size() == 2);
  CHECK(rising[0].records == std::vector<std::size_t>{0, 1});
  CHECK(mixed[0].records == std::vector<std::size_t>{0, 2});
  for (const std::size_t i : {0u, 1u}) CHECK(rising[i].speed_rpm == mixed[i].speed_rpm);
}

TEST_CASE("points are paired by speed and load, whatever their order", "[analysis]") {
  const auto matched =
      match_points(at({{605, 0}, {605, 100}, {1815, 0}}), at({{1815, 0}, {605, 100}, {605, 0}}));
  REQUIRE(matched.both.size() == 3);
  CHECK(matched.only_a.empty());
  CHECK(matched.only_b.empty());
  for (const MatchedPoint& point : matched.both) {
    CHECK(point.a.speed_rpm == point.b.speed_rpm);
    CHECK(point.a.load_pct == point.b.load_pct);
  }
}

TEST_CASE("a record of which no channel can be compared is in no point", "[analysis]") {
  auto records = at({{605, 0}, {605, 0}, {1210, 0}});
  records[1].channels.clear();
  records[2].channels.clear();
  const auto points = points_of(records);
  REQUIRE(points.size() == 1);
  CHECK(points[0].records == std::vector<std::size_t>{0});
}

TEST_CASE("a point that only one has is listed", "[analysis]") {
  const auto matched = match_points(at({{605, 0}, {605, 50}}), at({{605, 0}, {1210, 0}}));
  REQUIRE(matched.both.size() == 1);
  REQUIRE(matched.only_a.size() == 1);
  CHECK(matched.only_a[0].load_pct == 50);
  REQUIRE(matched.only_b.size() == 1);
  CHECK(matched.only_b[0].speed_rpm == 1210);
}

TEST_CASE("speeds within a percent are one, loads that nobody states are one", "[analysis]") {
  CHECK(match_points(at({{1797, not_known}}), at({{1802, not_known}})).both.size() == 1);
  CHECK(match_points(at({{1797, not_known}}), at({{1750, not_known}})).both.empty());
  CHECK(match_points(at({{1797, not_known}}), at({{1797, 0}})).both.empty());
  CHECK(match_points(at({{1797, 50}}), at({{-1797, 50}})).both.empty());  // other flanks
}

}  // namespace rvbench::analysis
