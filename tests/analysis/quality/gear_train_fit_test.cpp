#include "analysis/quality/gear_train_fit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "analysis/rv_reducer.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using analysis::Examination;
using analysis::gear_train_fit;
using analysis::GearTrainFit;
using analysis::Kinematics;

namespace {

// A pinion of 23 teeth that drives a wheel of 67, on shafts with nothing else.
Kinematics gear_pair() {
  Kinematics kinematics;
  kinematics.machine = "gear pair";
  kinematics.period_turns = 67;
  kinematics.orders = {{"pinion shaft", 1, "1", "pinion", "", false},
                       {"wheel shaft", 23.0 / 67, "23/67", "wheel", "", false},
                       {"mesh", 23, "23", "pinion", "", true}};
  return kinematics;
}

// A motor on a bearing: no teeth, and what rolls slips.
Kinematics motor() {
  Kinematics kinematics;
  kinematics.orders = {{"motor shaft", 1, "1", "motor", "", false},
                       {"outer race", 3.585, "", "bearing", "", false}};
  analysis::Signature outer;
  outer.component = "bearing";
  outer.order = 3.585;
  outer.slip = 0.02;
  kinematics.signatures = {outer};
  return kinematics;
}

// Ten periods of the gear train at a stated speed, and lines of one size in one channel.
Examination record_of(const std::vector<double>& orders, double period_turns) {
  Examination record;
  record.periods = 10 * 67 / period_turns;
  record.speed_rpm = 1800;
  record.channels.resize(1);
  for (const double order : orders) {
    record.channels[0].lines.push_back({order, 30 * order, 1, 1e-9, ""});
  }
  return record;
}

Examination record_of(const std::vector<double>& orders) { return record_of(orders, 67); }

const double wheel = 23.0 / 67;
const std::vector<double> mesh_with_sidebands{1, 2, 23, 46, 69, 23 - wheel, 23 + wheel, 46 + wheel};

}  // namespace

TEST_CASE("a mesh and its sidebands show which gear train it is", "[analysis][quality]") {
  const GearTrainFit fit = gear_train_fit({record_of(mesh_with_sidebands)}, gear_pair());
  CHECK(fit.is_shown());
  CHECK(fit.share == Approx(1));
  CHECK(std::isnan(fit.best_speed));
}

TEST_CASE("the mesh shows it beside a louder machine", "[analysis][quality]") {
  std::vector<double> lines = mesh_with_sidebands;
  Examination record = record_of(lines);
  for (const double order : {5.147, 10.294, 17.71, 31.33}) {
    record.channels[0].lines.push_back({order, 30 * order, 3, 1e-9, ""});
  }
  const GearTrainFit fit = gear_train_fit({record}, gear_pair());
  CHECK(fit.is_shown());
  CHECK(fit.share == Approx(6.0 / (6 + 36)));
}

TEST_CASE("harmonics of the input shaft show no gear train", "[analysis][quality]") {
  CHECK(gear_train_fit({record_of({1, 2, 3, 4, 20, 22, 24})}, gear_pair()).tried == 0);
  CHECK(gear_train_fit({}, gear_pair()).tried == 0);
  CHECK(gear_train_fit({record_of({})}, gear_pair()).tried == 0);
  std::vector<double> loose_shaft;  // the mesh's order among them
  for (int h = 1; h <= 50; ++h) loose_shaft.push_back(h);
  const Examination record = record_of(loose_shaft);
  CHECK_FALSE(gear_train_fit({record}, gear_pair()).is_shown());
  // Unless the mesh, and its second harmonic, stand out from them.
  Examination louder = record;
  auto& lines = louder.channels[0].lines;
  for (const std::size_t mesh : {23u, 46u}) lines[mesh - 1].amplitude = 3;
  std::ranges::stable_sort(lines, std::greater{}, &analysis::SpectralLine::amplitude);
  CHECK(gear_train_fit({louder}, gear_pair()).is_shown());
}

TEST_CASE("a short record shows a gear train, too, or is said to be too short",
          "[analysis][quality]") {
  Examination record = record_of(mesh_with_sidebands);
  record.periods = 0.3;  // 20 turns: lines lie a twentieth of an order apart
  CHECK(gear_train_fit({record}, gear_pair()).is_shown());
  record.periods = 0.005;
  const GearTrainFit fit = gear_train_fit({record}, gear_pair());
  CHECK(fit.is_too_short);
  CHECK_FALSE(fit.is_shown());
}

TEST_CASE("teeth of another gear are not this one's", "[analysis][quality]") {
  for (const int teeth : {19, 22, 24, 31}) {
    const double other = teeth / 61.0;
    const Examination record = record_of(
        {1, 2, double(teeth), 2.0 * teeth, teeth - other, teeth + other, 2 * teeth - other});
    CHECK_FALSE(gear_train_fit({record}, gear_pair()).is_shown());
  }
}

TEST_CASE("lines at a speed that is off name the speed at which they would fit",
          "[analysis][quality]") {
  for (const double speed : {0.96, 0.996, 0.9993, 1.02}) {
    std::vector<double> moved;
    for (const double order : mesh_with_sidebands) moved.push_back(speed * order);
    const GearTrainFit fit = gear_train_fit({record_of(moved)}, gear_pair());
    CHECK_FALSE(fit.is_shown());
    CHECK(fit.best_speed == Approx(speed).epsilon(3e-4));
    CHECK(fit.best_share > 0.7);
  }
}

TEST_CASE(
    "a speed that is wrong by a ratio is told from the right one, where harmonics fit as well",
    "[analysis][quality]") {
  for (const double speed : {0.1, 0.2, 0.5, 2.0 / 3, 1.5, 2.0, 5.0, 10.0}) {
    CAPTURE(speed);
    std::vector<double> moved;
    for (const double order : mesh_with_sidebands) moved.push_back(speed * order);
    const GearTrainFit fit = gear_train_fit({record_of(moved)}, gear_pair());
    CHECK_FALSE(fit.is_shown());
    CHECK(fit.best_speed == Approx(speed));
  }
  // A mesh with its harmonics alone fits at half the speed as well: at the right one it is shown.
  CHECK(gear_train_fit({record_of({1, 23, 46, 69, 92})}, gear_pair()).is_shown());
}

TEST_CASE("a machine without teeth has no lines of its own", "[analysis][quality]") {
  CHECK(has_own_lines(gear_pair()));
  CHECK_FALSE(has_own_lines(motor()));
}

TEST_CASE("lines of no gear train are taken for one about once in two hundred records",
          "[analysis][quality][statistics]") {
  const bool is_reducer = GENERATE(false, true);
  const Kinematics kinematics =
      is_reducer ? analysis::rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {11, 5, 26, 0}) : gear_pair();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> order(0.3, 60);
  std::lognormal_distribution<double> amplitude(0, 1);
  const int records = test::under_sanitizer ? 20 : 1500;
  int shown = 0;
  for (int i = 0; i < records; ++i) {
    std::vector<double> orders(30);
    for (double& o : orders) o = order(random);
    Examination record = record_of(orders, kinematics.period_turns);
    for (auto& line : record.channels[0].lines) line.amplitude = amplitude(random);
    shown += gear_train_fit({record}, kinematics).is_shown();
  }
  CAPTURE(kinematics.machine);
  const double expected = 2 * records / 395.0;
  CHECK(shown <= expected + 4 * std::sqrt(expected));
}
