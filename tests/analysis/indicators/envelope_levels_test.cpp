#include "analysis/indicators/envelope_levels.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "analysis/diagnosis.hpp"
#include "analysis/indicators/indicator_places.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::EnvelopeLevels;
using analysis::Indicator;
using analysis::Kinematics;
using test::OrderSignals;
using test::small_reducer;

namespace {

constexpr double carrier = 30;
const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 2000, .count = 16801};  // 8 periods

double order_of(const std::string& name) {
  const Kinematics machine = small_reducer();
  return std::ranges::find(machine.orders, name, &analysis::CharacteristicOrder::name)->order;
}

std::optional<double> level_of(const std::vector<Indicator>& all, const std::string& of) {
  const auto found = std::ranges::find_if(all, [&](const Indicator& i) {
    return i.measure == "envelope_order_level" && i.of == of && i.unit == "1";
  });
  return found == all.end() ? std::nullopt : std::optional(found->value);
}

std::vector<Indicator> levels_of(const Eigen::VectorXd& x, double share = 1) {
  EnvelopeLevels levels(small_reducer(), 0);
  levels.add(envelope_spectra(x, turning.rate_Hz, 0, turning.angle(), 21), share);
  return levels.indicators();
}

}  // namespace

TEST_CASE(
    "a carrier that swings by m at a shaft has an envelope level of m there, and none elsewhere",
    "[analysis][indicators]") {
  const double m = GENERATE(0.05, 0.4);
  for (const char* shaft : {"input shaft", "crank in housing"}) {
    CAPTURE(m, shaft);
    const auto all = levels_of(7 * turning.modulated(carrier, order_of(shaft), m));
    CHECK(*level_of(all, shaft) == Approx(m).epsilon(2e-3));
    CHECK(*level_of(all, "sun against carrier") < 0.01 * m);
  }
}

TEST_CASE("an even carrier has an envelope level of 0 at every order", "[analysis][indicators]") {
  const auto all = levels_of(turning.tone(carrier));
  CHECK_FALSE(all.empty());
  for (const Indicator& i : all) {
    CAPTURE(i.of);
    CHECK(i.value < 1e-3);
  }
}

TEST_CASE("a defect that slips is found beside its nominal order, and the gear train is not it",
          "[analysis][indicators]") {
  const std::string outer = "crank bearing_outer";  // nominally 44.4/21, and may slip by 2 %
  const double slipped = 44.5 / 21, locked = 44.0 / 21;
  REQUIRE(order_of(outer) == Approx(44.42 / 21).epsilon(1e-3));
  CHECK(*level_of(levels_of(turning.modulated(carrier, slipped, 0.3)), outer) ==
        Approx(0.3).epsilon(0.01));
  CHECK(*level_of(levels_of(turning.modulated(carrier, locked, 0.3)), outer) < 0.01);
}

TEST_CASE("modes weigh in the envelope as much as they carry of the signal",
          "[analysis][indicators]") {
  EnvelopeLevels levels(small_reducer(), 0);
  const auto add = [&](double depth, double share) {
    levels.add(envelope_spectra(turning.modulated(carrier, 1, depth), turning.rate_Hz, 0,
                                turning.angle(), 21),
               share);
  };
  add(0.4, 0.25);
  add(0, 0.75);
  CHECK(*level_of(levels.indicators(), "input shaft") == Approx(0.2).epsilon(2e-3));
}

TEST_CASE("an order that no envelope can hold is absent, and never 0", "[analysis][indicators]") {
  const auto all = levels_of(turning.modulated(4, 0.5, 0.3));  // holds no more than order 2
  CHECK(level_of(all, "input shaft"));
  CHECK_FALSE(level_of(all, "sun-planet mesh"));
  EnvelopeLevels brief(small_reducer(), 0);
  CHECK(brief.indicators().empty());
  brief.add({}, 1);  // less than a period
  CHECK(brief.indicators().empty());
}

TEST_CASE("an examined channel has the envelope levels of its modes", "[analysis][examine]") {
  const analysis::Examination e =
      examine(turning.recording(turning.modulated(carrier, 1, 0.4)), small_reducer());
  const std::vector<Indicator>& all = e.channels.at(0).indicators;
  CHECK(*level_of(all, "input shaft") == Approx(0.4).epsilon(0.02));
  const auto places = analysis::places_of("envelope_order_level", small_reducer());
  for (const Indicator& i : all) {
    if (i.measure == "envelope_order_level") CHECK(std::ranges::count(places, i.of) == 1);
  }
}
