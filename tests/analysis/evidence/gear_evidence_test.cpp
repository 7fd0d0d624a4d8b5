#include "analysis/evidence/gear_evidence.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/gear_train.hpp"
#include "analysis/order/order_lines.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::Kinematics;
using analysis::SignatureScore;
using test::OrderSignals;

namespace {

const OrderSignals gear_shaft{.speed_Hz = 30, .rate_Hz = 2400, .count = 38900};  // 4 periods of 121
constexpr double tooth_mesh = 1080.0 / 121, pin_pass = 1560.0 / 121;
constexpr double sun_order = 120.0 / 121, planet_order = 40.0 / 121, pins_order = 39.0 / 121;

// Two harmonics of the tooth mesh and one of the pin pass, each with its first sidebands of 5 %, as
// a sound reducer has them, and a path that turns with the carrier.
Eigen::VectorXd sound_reducer() {
  const Eigen::ArrayXd path = 1 + 0.3 * gear_shaft.tone(1.0 / 121, 0.2).array();
  const Eigen::ArrayXd swing = 1 + 0.05 * gear_shaft.tone(sun_order).array() +
                               0.05 * gear_shaft.tone(planet_order, 1).array();
  const Eigen::ArrayXd teeth =
      2 * gear_shaft.tone(tooth_mesh).array() + gear_shaft.tone(2 * tooth_mesh, 1).array();
  return path * swing * teeth +
         (1 + 0.05 * gear_shaft.tone(pins_order).array()) * gear_shaft.tone(pin_pass).array();
}

// A blow once per `1/order` turns, of so many turns' width, through the carrier's path.
Eigen::VectorXd tooth_blows(double order, double width_turns) {
  const Eigen::ArrayXd turns =
      test::times_s(gear_shaft.count, gear_shaft.rate_Hz) * gear_shaft.speed_Hz;
  const Eigen::ArrayXd phase =
      (turns * order).unaryExpr([](double x) { return x - std::round(x); });
  return (-(phase / width_turns / order).square()).exp();
}

// A shaft whose pinion of so many teeth drives a wheel of 31.
Kinematics one_mesh(int teeth) {
  return analysis::gear_train({.machine = "one mesh",
                               .shafts = {{"input", "input_shaft"}, {"output", "output_shaft"}},
                               .meshes = {{"mesh", 0, teeth, 1, 31, "pinion", "wheel"}},
                               .bearings = {}});
}

struct ScoredGears {
  Kinematics kinematics;
  std::vector<SignatureScore> scores = {};
  std::vector<analysis::PartLines> parts = {};

  const SignatureScore& of(const std::string& component) const {
    return scores[test::index_of(kinematics, component)];
  }
};

ScoredGears scored_gears(const Eigen::VectorXd& heard, double noise = 0.1, unsigned channels = 4,
                         const Kinematics& k = test::rv20e()) {
  std::vector<std::vector<analysis::GearReading>> readings;
  analysis::GearPlaces places;
  for (unsigned c = 1; c <= channels; ++c) {
    const Eigen::VectorXd x = heard + noise * gear_shaft.noise(c);
    const analysis::OrderLines lines(gear_shaft.channel(x), gear_shaft.angle(), k.period_turns);
    if (places.parts.empty())
      places =
          analysis::line_places(lines.turns(), lines.top_order(), gear_shaft.speed_Hz, true, k);
    readings.push_back(analysis::read_gears(lines.spectrum(), places));
  }
  ScoredGears result{k};
  result.parts = places.parts;
  for (std::size_t s = 0; s < k.signatures.size(); ++s) {
    result.scores.emplace_back().signature = static_cast<int>(s);
  }
  analysis::score_gears(readings, places, result.scores);
  return result;
}

}  // namespace

TEST_CASE("a sound mesh has 5 % of a shaft and nothing of any other part", "[analysis][evidence]") {
  const ScoredGears result = scored_gears(sound_reducer());
  CHECK(result.of("input_shaft").depth == Approx(0.05).epsilon(0.1));
  for (const char* part : {"sun_gear", "planet_gear", "pin_housing"}) {
    CAPTURE(part);
    CHECK(result.of(part).depth < 0.02);
  }
}

TEST_CASE("a mesh that swings once per turn of the sun is the shaft's, by how much it swings",
          "[analysis][evidence]") {
  const double depth = GENERATE(0.2, 0.7);
  const ScoredGears result = scored_gears(
      sound_reducer() +
      depth * (2 * gear_shaft.tone(tooth_mesh).array() * gear_shaft.tone(sun_order).array() +
               gear_shaft.tone(2 * tooth_mesh, 1).array() * gear_shaft.tone(sun_order).array())
                  .matrix());
  CHECK(result.of("input_shaft").p_value < 1e-6);
  // The 5 % of the sound mesh swing with it.
  CHECK(result.of("input_shaft").depth == Approx(depth + 0.05).epsilon(0.1));
  for (const char* part : {"sun_gear", "planet_gear", "pin_housing"}) {
    CHECK(result.of(part).depth < 0.03);
  }
}

TEST_CASE("a shaft's force is its own, also where its bend swings the sun's teeth",
          "[analysis][evidence]") {
  const Eigen::ArrayXd teeth = 0.3 * gear_shaft.tone(3 * sun_order, 1).array() +
                               0.3 * gear_shaft.tone(5 * sun_order).array();
  const Eigen::VectorXd bent = 1.5 * gear_shaft.tone(1) + gear_shaft.tone(2, 1);
  const ScoredGears result = scored_gears(
      sound_reducer() + bent + (2 * teeth * gear_shaft.tone(tooth_mesh).array()).matrix());
  CHECK(result.of("input_shaft").p_value < 1e-6);
  // Amplitudes of 1.5 and 1 over the rms of meshes of 2, 1 and 1.
  CHECK(result.of("input_shaft").depth == Approx(std::sqrt(2 * 3.25 / 6)).epsilon(0.1));
}

// The mesh of a pinion whose shaft swings it by 0.4. The amplitude of its sidebands is 0.4 of the
// rms of all harmonics.
TEST_CASE("a shaft shows by how much it swings, whatever its carriers' share",
          "[analysis][evidence]") {
  const auto [teeth, second] = GENERATE(table<int, double>({{20, 0.0}, {12, 0.2}, {12, 1.0}}));
  const Eigen::ArrayXd mesh =
      gear_shaft.tone(teeth).array() + second * gear_shaft.tone(2 * teeth, 1).array();
  const Eigen::ArrayXd swing = 1 + 0.4 * gear_shaft.tone(1, 2).array();
  const ScoredGears result = scored_gears(swing * mesh, 0.02, 4, one_mesh(teeth));
  CHECK(result.of("input_shaft").p_value < 1e-4);
  CHECK(result.of("input_shaft").depth == Approx(0.4).epsilon(0.1));
}

TEST_CASE("a resonance at one sideband makes no shaft swing", "[analysis][evidence]") {
  const Eigen::ArrayXd mesh = gear_shaft.tone(12).array() + 0.5 * gear_shaft.tone(24, 1).array();
  const Eigen::ArrayXd swing = 1 + 0.05 * gear_shaft.tone(1, 2).array();
  const Eigen::VectorXd resonant = 0.5 * gear_shaft.tone(11, 0.3);
  const ScoredGears result = scored_gears(swing * mesh + resonant.array(), 0.02, 4, one_mesh(12));
  CHECK(result.of("input_shaft").depth == Approx(0.05).margin(0.02));
}

TEST_CASE("a mesh that swings three and five times per turn of the sun is the sun's",
          "[analysis][evidence]") {
  const Eigen::ArrayXd teeth = 0.3 * gear_shaft.tone(3 * sun_order, 1).array() +
                               0.3 * gear_shaft.tone(5 * sun_order).array();
  const ScoredGears result =
      scored_gears(sound_reducer() + (2 * teeth * gear_shaft.tone(tooth_mesh).array()).matrix());
  CHECK(result.of("sun_gear").p_value < 1e-6);
  // Its own lines hold less than two fifths of what a bad profile does: by number. A fifth of their
  // power is left out, as the loudest may be a tone that happens to lie there.
  const double share = result.parts[test::index_of(test::rv20e(), "sun_gear")].share;
  CHECK(share > 0.2);
  CHECK(share < 0.4);
  CHECK(result.of("sun_gear").depth == Approx(std::sqrt(0.8 * 2 * 0.09 / share)).epsilon(0.1));
  CHECK(result.of("planet_gear").depth < 0.03);
  CHECK(result.of("input_shaft").depth < 0.06);
}

TEST_CASE("a tooth that strikes is its planet's, though every third line is the sun's",
          "[analysis][evidence]") {
  const ScoredGears result = scored_gears(sound_reducer() + 3 * tooth_blows(planet_order, 0.03));
  CHECK(result.of("planet_gear").p_value < 1e-6);
  CHECK(result.of("planet_gear").depth > 0.1);
  CHECK(result.of("sun_gear").depth < 0.02);
  CHECK(result.of("pin_housing").depth < 0.02);
  CHECK(result.of("input_shaft").depth < 0.06);
}

TEST_CASE("a pin that strikes is the pins'", "[analysis][evidence]") {
  const ScoredGears result = scored_gears(sound_reducer() + 3 * tooth_blows(2 * pins_order, 0.03));
  CHECK(result.of("pin_housing").p_value < 1e-6);
  CHECK(result.of("pin_housing").depth > 0.1);
  CHECK(result.of("planet_gear").depth < 0.02);
  CHECK(result.of("sun_gear").depth < 0.02);
}

TEST_CASE("a tone that does not keep to the shaft is no part's line", "[analysis][evidence]") {
  // It wanders by some lines around one of the planet's.
  const Eigen::ArrayXd turns =
      test::times_s(gear_shaft.count, gear_shaft.rate_Hz) * gear_shaft.speed_Hz;
  const Eigen::VectorXd wandering =
      (2 * std::numbers::pi * 200.0 / 121 * turns + 6 * gear_shaft.tone(1.0 / 300).array()).cos();
  CHECK(scored_gears(sound_reducer() + wandering).of("planet_gear").depth < 0.05);
}

TEST_CASE("noise hides what is small, and what it would hide is stated", "[analysis][evidence]") {
  double before = 0;
  for (const double noise : {0.1, 0.3, 1.0, 3.0}) {
    const ScoredGears result = scored_gears(sound_reducer(), noise);
    const double visible = result.of("planet_gear").smallest_visible;
    CAPTURE(noise, visible);
    CHECK(visible > 2 * before);
    before = visible;
  }
  CHECK(before > 0.05);
}

TEST_CASE("noise alone shows no part oftener than stated", "[analysis][evidence][null]") {
  int shown = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const ScoredGears result = scored_gears(gear_shaft.noise(1000 + seed), 0.5, 2);
    for (const char* part : {"input_shaft", "sun_gear", "planet_gear", "pin_housing"}) {
      shown += result.of(part).p_value < 0.01 ? 1 : 0;
    }
  }
  CHECK(shown <= 6);  // of 160 draws: 1.6 are expected
}
