#include "analysis/evidence/rolling_evidence.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "analysis/evidence/blow_power.hpp"
#include "analysis/evidence/residual_envelope.hpp"
#include "analysis/statistics.hpp"
#include "tests/analysis/order_signals.hpp"
#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::Kinematics;
using analysis::ResidualEnvelope;
using analysis::SignatureScore;
using test::OrderSignals;

namespace {

const OrderSignals ball_shaft{.speed_Hz = 20, .rate_Hz = 2560, .count = 43000};  // 16 periods of 21
constexpr double race_order = 10.0 / 21;
constexpr double inner_race = 5.5 * (1 + 5.0 / 26) * race_order;
constexpr double outer_race = 5.5 * (1 - 5.0 / 26) * race_order;

ResidualEnvelope residual_of(const Eigen::VectorXd& x) {
  const Kinematics k = test::small_reducer();
  const analysis::OrderLines lines(ball_shaft.channel(x), ball_shaft.angle(), k.period_turns);
  return analysis::residual_envelope(
      lines, analysis::residual_places(lines.turns(), lines.top_order(), k, 20));
}

// One sample long, `order` times per turn, with a scatter of a hundredth of the step.
Eigen::VectorXd race_blows(double order, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> scatter(1, 0.01);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(ball_shaft.count);
  const double step = ball_shaft.rate_Hz / ball_shaft.speed_Hz / order;
  for (double at = 0.4 * step; at < double(ball_shaft.count) - 1; at += step * scatter(generator)) {
    x[static_cast<Eigen::Index>(at)] = 1;
  }
  return x;
}

Eigen::VectorXd sound_meshes() {
  return 2 * ball_shaft.tone(240.0 / 21, 0.3) + ball_shaft.tone(90.0 / 21, 1);
}

struct ScoredBlows {
  std::vector<SignatureScore> scores;
  std::vector<analysis::UnknownFamily> unknown;

  const SignatureScore& of(const std::string& component) const {
    return scores[test::index_of(test::small_reducer(), component)];
  }
};

ScoredBlows scored_blows(const std::vector<Eigen::VectorXd>& channels) {
  std::vector<ResidualEnvelope> envelopes;
  for (const Eigen::VectorXd& x : channels) envelopes.push_back(residual_of(x));
  const Kinematics k = test::small_reducer();
  ScoredBlows result;
  for (std::size_t s = 0; s < k.signatures.size(); ++s) {
    SignatureScore& score = result.scores.emplace_back();
    score.signature = static_cast<int>(s);
    score.order = k.signatures[s].order;
  }
  result.unknown = analysis::score_rolling(envelopes, k, result.scores);
  return result;
}

ScoredBlows spalled_race(double order, double height) {
  std::vector<Eigen::VectorXd> channels;
  for (unsigned c = 1; c <= 4; ++c) {
    channels.push_back(sound_meshes() + height * race_blows(order, 7) + 0.3 * ball_shaft.noise(c));
  }
  return scored_blows(channels);
}

}  // namespace

TEST_CASE("gears and what is left are told apart by power", "[analysis][evidence]") {
  const ResidualEnvelope envelope = residual_of(sound_meshes() + 0.3 * ball_shaft.noise(1));
  CHECK(envelope.gears2 == Approx(0.5 * (4 + 1)).epsilon(0.01));
  // White noise to 0.4 of the rate, of 0.5; without the sixteenth that lies on gear lines.
  CHECK(envelope.residual2 == Approx(0.09 * 0.8 * 15 / 16).epsilon(0.03));
}

TEST_CASE("two carriers do not beat once the gears are taken out", "[analysis][evidence]") {
  const ResidualEnvelope envelope = residual_of(sound_meshes() + 0.3 * ball_shaft.noise(2));
  const auto beat = static_cast<Eigen::Index>(std::lround(150.0 / 21 / envelope.resolution));
  CHECK(envelope.lines.power[beat] < 12 * envelope.lines.floor[beat]);
}

TEST_CASE("noise that swings shows by how much", "[analysis][evidence]") {
  const Eigen::VectorXd x =
      sound_meshes() +
      (ball_shaft.noise(3).array() * (1 + 0.3 * ball_shaft.tone(1.234).array())).matrix();
  const ResidualEnvelope envelope = residual_of(x);
  const auto line = static_cast<Eigen::Index>(std::lround(1.234 / envelope.resolution));
  const double depth = std::sqrt(envelope.lines.power.segment(line - 2, 5).sum());
  // (1 + m·cos)²: 2·m at the order itself, over 1 + m²/2.
  // Dividing each line by the level around it takes a tenth of the swing with it.
  CHECK(depth == Approx(0.9 * 0.6 / 1.045).epsilon(0.1));
}

TEST_CASE("a spalled race is found at the order at which it slips", "[analysis][evidence]") {
  const bool is_inner = GENERATE(true, false);
  const double slip = GENERATE(0.985, 1.0, 1.01);
  const double order = (is_inner ? inner_race : outer_race) * slip;
  CAPTURE(is_inner, slip);
  const ScoredBlows result = spalled_race(order, 3);
  const SignatureScore& bad = result.of(is_inner ? "bearing_inner" : "bearing_outer");
  CHECK(bad.p_value < 1e-6);
  CHECK(bad.order == Approx(order).epsilon(1e-3));
  CHECK(result.of(is_inner ? "bearing_outer" : "bearing_inner").p_value > 1e-3);
  CHECK(result.unknown.empty());
}

TEST_CASE("the depth of blows is their amplitude over the gears' rms", "[analysis][evidence]") {
  const SignatureScore bad = spalled_race(inner_race, 3).of("bearing_inner");
  const double blows2 = 9 * inner_race * ball_shaft.speed_Hz / ball_shaft.rate_Hz;
  // What the scatter of the steps leaves in one line of the second harmonic, and the band to 0.4.
  CHECK(bad.depth == Approx(std::sqrt(2 * blows2 * 0.8 / 2.5)).epsilon(0.25));
}

// The blows stay, and the noise is drawn anew.
TEST_CASE("the depth of blows varies with noise by what is stated at the most",
          "[analysis][evidence]") {
  constexpr int draws = 24;
  const Eigen::VectorXd struck = sound_meshes() + 1.5 * race_blows(inner_race, 7);
  std::vector<double> depths2, variances;
  for (unsigned draw = 0; draw < draws; ++draw) {
    const SignatureScore bad =
        scored_blows({struck + 0.3 * ball_shaft.noise(100 + draw)}).of("bearing_inner");
    REQUIRE(bad.p_value < 1e-3);
    depths2.push_back(bad.depth * bad.depth);
    variances.push_back(bad.depth2_variance);
  }
  const double mean = std::accumulate(depths2.begin(), depths2.end(), 0.0) / draws;
  double squares = 0;
  for (const double depth2 : depths2) squares += (depth2 - mean) * (depth2 - mean);
  const double stated = std::sqrt(analysis::median(variances));
  CHECK(std::sqrt(squares / (draws - 1)) < stated);
  CHECK(stated < 0.2 * mean);
}

TEST_CASE("the lines listed are what the squared envelope holds", "[analysis][evidence]") {
  const double order = 415.0 / 336;  // a line of the record, and none of the gear train
  const Eigen::VectorXd x =
      sound_meshes() +
      (ball_shaft.noise(3).array() * (1 + 0.3 * ball_shaft.tone(order).array())).matrix();
  const ResidualEnvelope envelope = residual_of(x);
  CHECK(analysis::swing_at(envelope, order) == Approx(0.9 * 0.6 / 1.045).epsilon(0.15));
  CHECK(analysis::swing_at(envelope, 5.0 / 21) < 0.1);
  CHECK(analysis::swing_at(envelope, 2.5 * order) < 0.15);
  const SignatureScore bad = spalled_race(inner_race, 3).of("bearing_inner");
  REQUIRE(bad.line_orders.size() == 4);
  CHECK(bad.line_depths[0] > bad.line_depths[3]);
}

TEST_CASE("one cage speed ties both races", "[analysis][evidence]") {
  // An inner race 1.5 % slow makes the cage 2.2 % fast: blows at the outer race's nominal order are
  // then not the outer race's.
  std::vector<Eigen::VectorXd> channels;
  for (unsigned c = 1; c <= 4; ++c) {
    channels.push_back(sound_meshes() + 3 * race_blows(0.985 * inner_race, 7) +
                       1.2 * race_blows(outer_race, 8) + 0.3 * ball_shaft.noise(c));
  }
  const ScoredBlows result = scored_blows(channels);
  CHECK(result.of("bearing_inner").p_value < 1e-6);
  CHECK(result.of("bearing_outer").p_value > 1e-3);
}

TEST_CASE("blows of no part of the machine are an unknown family", "[analysis][evidence]") {
  const ScoredBlows result = spalled_race(1.777, 3);
  REQUIRE(result.unknown.size() == 1);
  CHECK(result.unknown[0].spacing == Approx(1.777).epsilon(0.005));
  CHECK(result.unknown[0].harmonics >= 4);
  CHECK_FALSE(result.unknown[0].is_locked);
  for (const char* part : {"bearing_inner", "bearing_outer"}) CHECK(result.of(part).p_value > 1e-3);
}

TEST_CASE("noise has neither a bad race nor an unknown family", "[analysis][evidence][null]") {
  int shown = 0, unknown = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ScoredBlows result = scored_blows({sound_meshes() + ball_shaft.noise(10 * seed),
                                             sound_meshes() + ball_shaft.noise(10 * seed + 1)});
    for (const char* part : {"bearing_inner", "bearing_outer", "bearing_ball", "bearing_cage"}) {
      shown += result.of(part).p_value < 1e-3 ? 1 : 0;
    }
    unknown += result.unknown.empty() ? 0 : 1;
  }
  CHECK(shown == 0);
  CHECK(unknown == 0);
}

TEST_CASE("what would be visible grows with the noise", "[analysis][evidence]") {
  double before = 0;
  for (const double noise : {0.1, 0.3, 1.0}) {
    std::vector<Eigen::VectorXd> channels;
    for (unsigned c = 1; c <= 4; ++c)
      channels.push_back(sound_meshes() + noise * ball_shaft.noise(c));
    const double visible = scored_blows(channels).of("bearing_inner").smallest_visible;
    CAPTURE(noise, visible);
    CHECK(visible > 2 * before);
    before = visible;
  }
}
