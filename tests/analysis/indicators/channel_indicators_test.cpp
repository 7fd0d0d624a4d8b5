#include "analysis/indicators/channel_indicators.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>

#include "analysis/indicators/indicator_places.hpp"
#include "analysis/spectral_lines.hpp"
#include "hal/types/measure.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::Indicator;
using analysis::Kinematics;
using test::OrderSignals;
using test::small_reducer;

namespace {

// i = 21: sun at 20/21 with 12 teeth, planet at 10/21 with 24, pins and lobes at 90/21.
constexpr double sun = 20.0 / 21;
constexpr double mesh = 12 * sun;
const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 1280, .count = 10760};  // 8 periods

analysis::ChannelIndicators all_of(const Channel& channel, const analysis::ShaftAngle& angle,
                                   const Kinematics& machine = small_reducer()) {
  const analysis::OrderLines lines(channel, angle, machine.period_turns);
  const auto heard = analysis::spectral_lines(lines, machine);
  return analysis::channel_indicators(channel, lines, machine, heard);
}

analysis::ChannelIndicators all_of(const Eigen::VectorXd& x, const OrderSignals& shaft) {
  return all_of(shaft.channel(x), shaft.angle());
}

// As they are where the speed was stated, off by so much, and no angle measured.
analysis::ChannelIndicators with_stated_speed(const Eigen::VectorXd& x, double relative_error) {
  Recording record;
  record.speed_rpm = 60 * turning.speed_Hz * (1 + relative_error);
  record.channels = {turning.channel(x)};
  return all_of(record.channels[0], *analysis::ShaftAngle::of(record));
}

std::vector<Indicator> indicators_of(const Eigen::VectorXd& x,
                                     const OrderSignals& shaft = turning) {
  return all_of(x, shaft).list;
}

std::optional<double> value_of(const std::vector<Indicator>& all, std::string_view measure,
                               const std::string& of = "") {
  const auto found = std::ranges::find_if(
      all, [&](const Indicator& i) { return i.measure == measure && i.of == of; });
  return found == all.end() ? std::nullopt : std::optional(found->value);
}

Eigen::VectorXd faint(unsigned seed) { return 1e-3 * turning.noise(seed); }

// One tooth of the sun, struck each time it is in mesh.
Eigen::VectorXd struck_tooth() {
  const Eigen::ArrayXd turns =
      sun * turning.speed_Hz * test::times_s(turning.count, turning.rate_Hz);
  return (-(60 * (turns - turns.round())).square()).exp();
}

}  // namespace

TEST_CASE("levels of a sine are those of a sine, in the unit of the channel",
          "[analysis][indicators]") {
  const auto all = indicators_of(3 * turning.tone(mesh).array() + 50);
  CHECK(*value_of(all, "acceleration_rms") == Approx(3 / std::sqrt(2)).epsilon(1e-3));
  CHECK(*value_of(all, "acceleration_peak") == Approx(3).epsilon(1e-3));
  CHECK(*value_of(all, "crest_factor") == Approx(std::sqrt(2)).epsilon(1e-3));
  CHECK(*value_of(all, "kurtosis") == Approx(1.5).epsilon(1e-3));
  CHECK(*value_of(all, "band_rms", "sun-planet mesh") == Approx(3 / std::sqrt(2)).epsilon(1e-3));
  CHECK(*value_of(all, "band_kurtosis", "sun-planet mesh") == Approx(1.5).epsilon(1e-3));
  CHECK(*value_of(all, "band_rms", "below the meshes") < 1e-2);
  CHECK(*value_of(all, "order_level", "sun-planet mesh") == Approx(3).epsilon(1e-3));
  for (const Indicator& i : all) {
    CAPTURE(i.measure);
    const Measure* measure = find_measure(i.measure);
    REQUIRE(measure != nullptr);
    CHECK(i.unit == measure->units.front());
  }
}

TEST_CASE("a mesh that swings by m at a shaft has a sideband ratio of m there, and nowhere else",
          "[analysis][indicators]") {
  const double m = GENERATE(0.1, 0.6);
  const auto all = indicators_of(turning.modulated(mesh, 1, m) + faint(1));
  CHECK(*value_of(all, "sideband_ratio", "sun-planet mesh at input shaft") ==
        Approx(m).epsilon(0.01));
  CHECK(*value_of(all, "sideband_ratio", "sun-planet mesh at sun against carrier") < 0.01);
  CHECK(*value_of(all, "sideband_ratio", "sun-planet mesh at crank in housing") < 0.01);
}

TEST_CASE("FM0 of a mesh that is one sine is 2, and grows with a tooth that stands out",
          "[analysis][indicators]") {
  const std::string place = "sun-planet mesh, sun against carrier";
  CHECK(*value_of(indicators_of(turning.tone(mesh) + faint(1)), "fm0", place) ==
        Approx(2).epsilon(0.02));
  CHECK(*value_of(indicators_of(turning.tone(mesh) + 2 * struck_tooth() + faint(1)), "fm0", place) >
        2.5);
}

TEST_CASE("FM4 is 3 for a sound gear in noise, and grows with one struck tooth of that gear",
          "[analysis][indicators]") {
  const Eigen::VectorXd sound =
      turning.tone(mesh) + turning.tone(90.0 / 21) + 0.1 * turning.noise(3);
  const auto fm4 = [](const Eigen::VectorXd& x, const char* gear) {
    return *value_of(indicators_of(x), "fm4", std::string("sun-planet mesh, ") + gear);
  };
  // 64 samples of an average: its kurtosis scatters by √(24/64) = 0.6.
  CHECK(fm4(sound, "sun against carrier") == Approx(3).margin(1.8));
  CHECK(fm4(sound + struck_tooth(), "sun against carrier") > 8);
  // The planet turns at half the sun's speed: two strikes a turn still stand out of 24 teeth.
  CHECK(fm4(sound, "planet against carrier") == Approx(3).margin(1.8));
}

TEST_CASE("where no mesh is heard nothing is set in relation to it", "[analysis][indicators]") {
  const auto all = indicators_of(turning.noise(5));
  for (const char* measure : {"sideband_ratio", "fm0"}) {
    CAPTURE(measure);
    CHECK(std::ranges::count(all, measure, &Indicator::measure) == 0);
  }
  CHECK(value_of(all, "kurtosis"));
}

TEST_CASE("of a mesh that noise almost drowns no ratio is told, though its line is heard",
          "[analysis][indicators]") {
  const std::string gear = "sun-planet mesh, sun against carrier";
  const std::string sides = "sun-planet mesh at input shaft";
  // Under a Hann window n samples of white noise of rms 1 have lines of √(6/n) rms.
  const double line_noise = std::sqrt(6.0 / double(turning.count));
  const unsigned seed = GENERATE(1U, 2U, 3U);
  CAPTURE(seed);
  const auto with_mesh = [&](double over_noise) {
    return indicators_of(over_noise * line_noise * turning.tone(mesh) + turning.noise(seed));
  };
  const auto weak = with_mesh(10);  // 20 dB
  CHECK_FALSE(value_of(weak, "sideband_ratio", sides));
  CHECK_FALSE(value_of(weak, "fm0", gear));
  CHECK(value_of(weak, "order_level", "sun-planet mesh"));

  // What is told beyond is the mesh's, to what noise may add: 6·√(π/4)/40 on average.
  const auto clear = with_mesh(40);
  REQUIRE(value_of(clear, "sideband_ratio", sides));
  CHECK(*value_of(clear, "sideband_ratio", sides) < 2 * 6 * 0.886 / 40);
  const auto loud = with_mesh(400);
  CHECK(*value_of(loud, "fm0", gear) == Approx(2).margin(0.5));
}

TEST_CASE("the residual of a gear is what swings beside its mesh, sidebands among it",
          "[analysis][indicators]") {
  const std::string gear = "sun-planet mesh, sun against carrier";
  const auto variance_of = [&](const Eigen::VectorXd& x) {
    const auto all = all_of(x, turning).residuals;
    const auto found = std::ranges::find(all, gear, &analysis::GearResidual::of);
    return found == all.end() ? 0 : found->moments.variance;
  };
  // Three turns of the sun from mesh to mesh: two sidebands of m/2 have a variance of m²/4.
  CHECK(variance_of(turning.modulated(mesh, 3 * sun, 0.4)) == Approx(0.04).epsilon(0.01));
  CHECK(variance_of(turning.tone(mesh) + turning.tone(sun) + faint(1)) < 1e-4);
}

TEST_CASE("with a speed that was stated no ratio is read off lines that it does not place",
          "[analysis][indicators]") {
  const Eigen::VectorXd x = turning.modulated(mesh, 1, 0.3) + struck_tooth() + faint(1);
  const auto stated = with_stated_speed(x, 2.5e-4);  // half a line at the mesh
  for (const char* measure : {"sideband_ratio", "fm0", "fm4"}) {
    CAPTURE(measure);
    CHECK(std::ranges::count(stated.list, measure, &Indicator::measure) == 0);
  }
  CHECK(stated.residuals.empty());
  CHECK(*value_of(stated.list, "order_level", "sun-planet mesh") == Approx(1.07).epsilon(0.2));
  // 21 turns have lines so wide that it places them.
  const auto brief = with_stated_speed(x.head(1350), 2.5e-4);
  CHECK(*value_of(brief.list, "sideband_ratio", "sun-planet mesh at input shaft") ==
        Approx(0.3).epsilon(0.25));
  CHECK(value_of(brief.list, "fm4", "sun-planet mesh, sun against carrier"));
}

TEST_CASE("of two meshes at one order both are heard", "[analysis][indicators]") {
  Kinematics twin = small_reducer();
  const auto first =
      std::ranges::find(twin.orders, "sun-planet mesh", &analysis::CharacteristicOrder::name);
  REQUIRE(first != twin.orders.end());
  analysis::CharacteristicOrder second_order = *first;
  second_order.name = "second mesh";
  twin.orders.push_back(second_order);
  twin.meshes.push_back({"second mesh", mesh, {{"second sun", sun, 12}}});
  const auto all =
      all_of(turning.channel(turning.modulated(mesh, 1, 0.3) + faint(1)), turning.angle(), twin);
  for (const char* name : {"sun-planet mesh", "second mesh"}) {
    CAPTURE(name);
    const auto ratio = value_of(all.list, "sideband_ratio", std::string(name) + " at input shaft");
    REQUIRE(ratio);
    CHECK(*ratio == Approx(0.3).epsilon(0.01));
  }
  CHECK(value_of(all.list, "fm0", "second mesh, second sun"));
}

TEST_CASE("what a record does not hold is absent, and never 0", "[analysis][indicators]") {
  const OrderSignals brief{.speed_Hz = 20, .rate_Hz = 1280, .count = 1280};  // less than a period
  for (const Indicator& i : indicators_of(brief.tone(mesh), brief)) CHECK(i.of.empty());

  const OrderSignals coarse{.speed_Hz = 20, .rate_Hz = 400, .count = 3363};  // orders up to 8
  const auto all = indicators_of(coarse.tone(1), coarse);
  CHECK(value_of(all, "order_level", "input shaft"));
  CHECK_FALSE(value_of(all, "order_level", "sun-planet mesh"));
  CHECK_FALSE(value_of(all, "band_rms", "above the meshes"));
  CHECK_FALSE(value_of(all, "fm4", "sun-planet mesh, sun against carrier"));

  const OrderSignals two_periods{.speed_Hz = 20, .rate_Hz = 1280, .count = 2700};
  // Sidebands of the carrier lie two lines from the mesh: not parted from it.
  const auto few = indicators_of(two_periods.tone(mesh), two_periods);
  CHECK_FALSE(value_of(few, "sideband_ratio", "sun-planet mesh at carrier and cycloid disc"));
  CHECK_FALSE(value_of(few, "order_level", "carrier and cycloid disc"));

  const auto dead = indicators_of(Eigen::VectorXd::Constant(turning.count, 2));
  CHECK(*value_of(dead, "acceleration_rms") == 0);
  CHECK_FALSE(value_of(dead, "kurtosis"));
  CHECK_FALSE(value_of(dead, "crest_factor"));
}

TEST_CASE("every indicator is at a place that a limit can name", "[analysis][indicators]") {
  const Kinematics machine = small_reducer();
  const auto all = indicators_of(turning.modulated(mesh, 1, 0.3) + turning.tone(90.0 / 21) +
                                 0.01 * turning.noise(1));
  for (const char* measure : {"band_rms", "order_level", "sideband_ratio", "fm0", "fm4"}) {
    CAPTURE(measure);
    const auto places = analysis::places_of(measure, machine);
    CHECK(std::ranges::count(all, measure, &Indicator::measure) ==
          static_cast<std::ptrdiff_t>(places.size()));
    for (const Indicator& i : all) {
      if (i.measure == measure) CHECK(std::ranges::count(places, i.of) == 1);
    }
  }
  CHECK(analysis::places_of("kurtosis", machine).empty());
}

TEST_CASE("rolling elements slip, so no level is told at their orders", "[analysis][indicators]") {
  for (const std::string& place : analysis::places_of("order_level", small_reducer())) {
    CAPTURE(place);
    CHECK(place.find("bearing") == std::string::npos);
  }
}
