#include "analysis/compare/quantities.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "analysis/gear_train.hpp"
#include "analysis/rv_reducer.hpp"
#include "tests/analysis/compare/compared_records.hpp"

namespace rvbench::analysis {
namespace {

const Quantity* find(const std::vector<Quantity>& all, double order) {
  const auto found = std::ranges::find_if(
      all, [&](const Quantity& q) { return std::abs(q.order - order) < 1e-9; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

TEST_CASE("levels come first, then the lines of the machine by rising order", "[analysis]") {
  const std::vector<Quantity> all = quantities_to_compare(test::small_gear());
  REQUIRE(all.size() > 4);
  CHECK(all[0].name == "rms");
  CHECK(all[3].name == "kurtosis");
  CHECK(std::is_sorted(all.begin() + 4, all.end(),
                       [](const Quantity& a, const Quantity& b) { return a.order < b.order; }));
  CHECK(std::all_of(all.begin() + 4, all.end(), [](const Quantity& q) { return q.is_line(); }));
}

TEST_CASE("a line has the name that says most about it", "[analysis]") {
  const std::vector<Quantity> all = quantities_to_compare(test::small_gear());
  CHECK(find(all, 1)->name == "input shaft");  // not the wheel's third harmonic
  CHECK(find(all, 2)->name == "input shaft x2");
  CHECK(find(all, 2.0 / 3)->name == "wheel shaft x2");
  CHECK(find(all, 24)->name == "mesh x3");
  CHECK(find(all, 7)->name == "mesh - input shaft");
  CHECK(find(all, 8 + 1.0 / 3)->name == "mesh + wheel shaft");
  CHECK(find(all, 8 + 1.0 / 3)->component == "wheel");
  CHECK(find(all, 5) == nullptr);
}

TEST_CASE("orders that are one line of the spectrum are compared once", "[analysis]") {
  const Kinematics k = rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {});
  const std::vector<Quantity> all = quantities_to_compare(k);
  CHECK(find(all, 39.0 / 121)->name == "crank in housing, planet in housing");
  for (std::size_t i = 5; i < all.size(); ++i) CHECK(all[i].order - all[i - 1].order > 1e-6);
}

TEST_CASE("lines of a signature know it, also where they have a simpler name", "[analysis]") {
  const Kinematics k = rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {});
  const std::vector<Quantity> all = quantities_to_compare(k);
  const auto is_of = [&](double order, const std::string& component) {
    const Quantity* line = find(all, order);
    REQUIRE(line != nullptr);
    return std::ranges::any_of(line->families, [&](std::size_t family) {
      return k.signatures[family].component == component;
    });
  };
  CHECK(is_of(1, "input_shaft"));
  CHECK(is_of(201.0 / 121, "planet_gear"));  // five times 40/121, and 1/121
  CHECK(find(all, 201.0 / 121)->name == "planet gear x5 + carrier and cycloid disc");
  CHECK(is_of(959.0 / 121, "planet_gear"));  // 24 times 40/121, less 1/121
  CHECK(find(all, 959.0 / 121)->name == "sun-planet mesh - input shaft");
  CHECK_FALSE(is_of(1560.0 / 121, "planet_gear"));
}

TEST_CASE("the line of a rolling element may stray, that of a shaft not", "[analysis]") {
  GearTrain train;
  train.machine = "motor";
  train.shafts = {{"shaft", "motor"}};
  train.bearings = {{"drive end", 0, {9, 7.94, 39.04, 0}, 0.02}};
  const std::vector<Quantity> all = quantities_to_compare(gear_train(train));
  const BearingOrders orders = bearing_orders({9, 7.94, 39.04, 0});
  REQUIRE(find(all, orders.outer) != nullptr);
  CHECK(find(all, orders.outer)->stray == Approx(0.02));
  CHECK(find(all, 1)->stray == 0);
}

}  // namespace rvbench::analysis
