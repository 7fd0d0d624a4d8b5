#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::conclude;
using analysis::Diagnosis;
using analysis::Examination;
using analysis::examine;
using analysis::Kinematics;
using analysis::SignatureScore;
using test::OrderSignals;
using test::small_reducer;

namespace {

constexpr double mesh = 240.0 / 21;
constexpr double lobes = 90.0 / 21;
const OrderSignals turning{.speed_Hz = 20, .rate_Hz = 1280, .count = 10760};  // 8 periods

const SignatureScore& score_of(const std::string& component, const Examination& e) {
  return e.scores.at(test::index_of(small_reducer(), component));
}

// Meshes of a sound reducer: lines without sidebands, in noise.
Eigen::VectorXd sound(const OrderSignals& shaft, unsigned seed) {
  return 2 * shaft.tone(mesh, 0.3) + shaft.tone(lobes, 1) + 0.3 * shaft.noise(seed);
}

Eigen::VectorXd faulty(double order, unsigned seed) {
  return 2 * turning.modulated(mesh, order, 0.5) + turning.tone(lobes, 1) +
         0.2 * turning.noise(seed);
}

// Blows of one sample, `order` times per turn, beside sound meshes.
Eigen::VectorXd struck(double order, unsigned seed) {
  Eigen::VectorXd x = sound(turning, seed);
  const double step = turning.rate_Hz / turning.speed_Hz / order;
  for (double at = 0.3 * step; at < static_cast<double>(turning.count) - 1; at += step) {
    x[static_cast<Eigen::Index>(std::lround(at))] += 8;
  }
  return x;
}

constexpr double sun = 20.0 / 21;

// Of a swing by 0.5. Of the two first sidebands the upper, 260/21, is the planet's of the third
// harmonic of the lobes as well, and is not asked.
const double swing_of_one_side = 0.5 / std::sqrt(2);

std::string leading(const Diagnosis& d) {
  return d.findings.empty() ? "" : d.findings.front().component;
}

}  // namespace

TEST_CASE("a channel is described by moments that a sine is known by", "[analysis][examine]") {
  const Examination e =
      examine(turning.recording(3 * turning.tone(4).array() + 50), small_reducer());
  REQUIRE(e.channels.size() == 1);
  CHECK(e.channels[0].rms == Approx(3 / std::sqrt(2)).epsilon(1e-3));
  CHECK(e.channels[0].peak == Approx(3).epsilon(1e-3));
  CHECK(e.channels[0].kurtosis == Approx(1.5).epsilon(1e-3));
  CHECK(e.channels[0].imf_correlation.front() == Approx(1).epsilon(1e-3));  // it is its own IMF
  CHECK(e.speed_rpm == 1200);
  CHECK(e.periods == 8);
}

TEST_CASE("a mesh that swings with the sun's turn is the input shaft's", "[analysis][examine]") {
  const Kinematics k = small_reducer();
  const Examination e = examine(turning.recording(faulty(sun, 1)), k);
  const SignatureScore& score = score_of("input_shaft", e);
  CHECK(score.p_value < 1e-6);
  const Diagnosis d = conclude({e}, k);
  REQUIRE(leading(d) == "input_shaft");
  CHECK(d.findings.front().severity == Approx(swing_of_one_side).epsilon(0.1));
  CHECK(d.findings.front().points == std::vector<std::string>{"synthetic"});
  const double deepest = d.findings.front().line_orders.front();
  CHECK(std::abs(deepest - mesh) == Approx(sun).margin(1e-6));
  CHECK(score.imf > 0);
}

TEST_CASE("noise that swings with a part's turn is that part's, too", "[analysis][examine]") {
  struct Fault {
    const char* component;
    double order;
  };
  // The planet's and the pins' first harmonic is what sound parts show, too.
  const auto fault = GENERATE(Fault{"input_shaft", 1}, Fault{"sun_gear", sun},
                              Fault{"planet_gear", 50.0 / 21}, Fault{"pin_housing", 36.0 / 21});
  CAPTURE(fault.component);
  const Kinematics k = small_reducer();
  const Eigen::VectorXd swinging =
      turning.noise(3).array() * (1 + 0.5 * turning.tone(fault.order).array());
  const Diagnosis d = conclude({examine(turning.recording(sound(turning, 4) + swinging), k)}, k);
  REQUIRE(leading(d) == fault.component);
  CHECK(d.findings.front().severity == Approx(0.5).epsilon(0.3));
}

TEST_CASE("noise that swings by a tenth, as a sound contact's does, is no evidence",
          "[analysis][examine][null]") {
  const double order = GENERATE(1.0, sun, 50.0 / 21, 36.0 / 21);
  CAPTURE(order);
  const auto shown_by_noise = [&](double swing) {
    const Eigen::VectorXd swinging =
        turning.noise(3).array() * (1 + swing * turning.tone(order).array());
    const Examination e = examine(turning.recording(sound(turning, 4) + swinging), small_reducer());
    return std::ranges::count_if(e.scores, &SignatureScore::by_noise);
  };
  CHECK(shown_by_noise(0.1) == 0);
  CHECK(shown_by_noise(0.2) > 0);
}

TEST_CASE("a bearing that slips is found at the order at which it slips", "[analysis][examine]") {
  const Kinematics k = small_reducer();
  const double slipped = 5.5 * (1 - 5.0 / 26) * 10 / 21 * 0.985;
  const Diagnosis d = conclude({examine(turning.recording(struck(slipped, 2)), k)}, k);
  REQUIRE(leading(d) == "bearing_outer");
  CHECK(d.findings.front().order == Approx(slipped).epsilon(2e-3));
  CHECK(d.findings.front().frequency_Hz == Approx(d.findings.front().order * 20));
}

TEST_CASE("nothing is significant in sound meshes and noise", "[analysis][examine][null]") {
  // 30 records, of which 1 in 1000 may show something significant, be it below its limit.
  const Kinematics k = small_reducer();
  std::size_t significant = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Diagnosis d = conclude({examine(turning.recording(sound(turning, seed)), k)}, k);
    CHECK(d.resolvable);
    significant += d.findings.size() + d.below_limit.size();
  }
  CHECK(significant == 0);
}

TEST_CASE("nothing is significant in noise, whatever its colour", "[analysis][examine][null]") {
  const Kinematics k = small_reducer();
  std::size_t significant = 0;
  for (unsigned seed = 1; seed <= 15; ++seed) {
    for (const Eigen::VectorXd& x : {turning.noise(seed), test::reddened(turning.noise(seed), 0.9),
                                     test::reddened(turning.noise(seed), 0.99)}) {
      const Diagnosis d = conclude({examine(turning.recording(x), k)}, k);
      significant += d.findings.size() + d.below_limit.size();
    }
  }
  CHECK(significant == 0);
}

TEST_CASE("an amplitude that swings with the mains is no part's fault", "[analysis][examine]") {
  // 100 Hz over a shaft at 19.83 Hz: order 5.043, between 105/21 and 106/21.
  OrderSignals slipping = turning;
  slipping.speed_Hz = 19.83;
  const Eigen::VectorXd x =
      2 * slipping.modulated(mesh, 100 / 19.83, 0.5) + 0.2 * slipping.noise(3);
  const Kinematics k = small_reducer();
  CHECK(conclude({examine(slipping.recording(x), k)}, k).findings.empty());
}

TEST_CASE("a motor 1 % below its planned speed is judged at the speed it has",
          "[analysis][examine]") {
  OrderSignals slipping = turning;
  slipping.speed_Hz = 19.8;
  Recording record =
      slipping.recording(2 * slipping.modulated(mesh, sun, 0.5) + 0.2 * slipping.noise(4));
  record.planned_speed_rpm = 1200;
  const bool angle_is_known = GENERATE(true, false);
  CAPTURE(angle_is_known);
  if (!angle_is_known) record.channels.pop_back();
  const Kinematics k = small_reducer();
  const Diagnosis d = conclude({examine(record, k)}, k);
  REQUIRE(leading(d) == "input_shaft");
  CHECK(d.findings.front().severity == Approx(swing_of_one_side).epsilon(0.1));
  CHECK(d.findings.front().frequency_Hz == Approx(19.8));
}

TEST_CASE("a fault that most channels show is found, deepest where it is", "[analysis][examine]") {
  Recording record = turning.recording(sound(turning, 5));
  record.channels.push_back(turning.channel(faulty(sun, 6), "accel_2x"));
  record.channels.push_back(
      turning.channel(0.9 * faulty(sun, 7) + 0.1 * sound(turning, 8), "accel_3x"));
  const Kinematics k = small_reducer();
  const Examination e = examine(record, k);
  const SignatureScore& shaft = score_of("input_shaft", e);
  CHECK(e.channels[static_cast<std::size_t>(shaft.channel)].name == "accel_2x");
  CHECK(leading(conclude({e}, k)) == "input_shaft");
}

TEST_CASE("the length that most channels have is the one that is judged by",
          "[analysis][examine]") {
  const OrderSignals longer{.speed_Hz = 20, .rate_Hz = 1280, .count = 2 * turning.count};
  Recording record = longer.recording(sound(longer, 5));
  record.channels.push_back(turning.channel(faulty(sun, 6), "accel_2x"));
  record.channels.push_back(turning.channel(faulty(sun, 7), "accel_3x"));
  const Kinematics k = small_reducer();
  const Examination e = examine(record, k);
  CHECK(leading(conclude({e}, k)) == "input_shaft");
  CHECK(e.periods == Approx(8).margin(0.1));
  REQUIRE(e.quality.size() == 1);
  CHECK_THAT(e.quality[0].where, Catch::Contains(e.channels[0].name));
  CHECK_FALSE(e.quality[0].invalidates);
}

TEST_CASE("a signal in two channels is told, and weighed once", "[analysis][examine]") {
  Recording record = turning.recording(faulty(sun, 5));
  const Examination alone = examine(record, small_reducer());
  record.channels.push_back(record.channels.front());
  record.channels.back().info.name = "copy";
  const Examination e = examine(record, small_reducer());
  REQUIRE(e.quality.size() == 1);
  CHECK_THAT(e.quality[0].where, Catch::Contains("copy"));
  CHECK_THAT(e.quality[0].what, Catch::Contains("the same samples as " + e.channels[0].name));
  CHECK_FALSE(e.quality[0].invalidates);
  CHECK(score_of("input_shaft", e).log_likelihood_ratio ==
        Approx(score_of("input_shaft", alone).log_likelihood_ratio));
}

TEST_CASE("a channel that only drifts is told, and is no evidence", "[analysis][examine]") {
  const Kinematics k = small_reducer();
  const Examination e = examine(turning.recording(1e6 * turning.tone(0.001) + turning.noise(9)), k);
  REQUIRE(e.quality.size() >= 1);
  CHECK_THAT(e.quality.front().what, Catch::Matchers::StartsWith("drift"));
  for (const SignatureScore& score : e.scores) {
    CHECK(score.p_value == 1);
    CHECK(score.depth == 0);
  }
}

TEST_CASE("the verdict does not change with the unit", "[analysis][examine]") {
  const Kinematics k = small_reducer();
  const Eigen::VectorXd x = faulty(sun, 8);
  const Diagnosis in_m_s2 = conclude({examine(turning.recording(x), k)}, k);
  const Diagnosis scaled = conclude({examine(turning.recording(1e-6 * x), k)}, k);
  REQUIRE(scaled.findings.size() == in_m_s2.findings.size());
  CHECK(scaled.findings.front().severity ==
        Approx(in_m_s2.findings.front().severity).epsilon(1e-6));
}
