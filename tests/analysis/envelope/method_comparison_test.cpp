#include "analysis/envelope/method_comparison.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/kinematics.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/analysis/envelope/strikes.hpp"
#include "tests/analysis/null_rates.hpp"
#include "tests/support/real_data.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::NoOftenerThanStated;
using test::NullDraws;
using test::Strikes;
using test::white_noise;

namespace {

constexpr double rate_Hz = 8000;

const MethodEvidence& evidence_of(const MethodComparison& c, std::size_t candidate,
                                  EnvelopeMethod method) {
  return c.evidence.at(candidate).at(static_cast<std::size_t>(method));
}

// Neither of the shaft or the cage (0.398), nor a few of them away from a race's.
constexpr double no_part = 1.3;

struct Found {
  double shaft_Hz = 0;
  MethodComparison comparison;  // candidates: inner race, outer race, ball, cage, and no part
};

// The 6205 of the CWRU rig, whose rolling elements slip by 1 % at the most.
Found in_recording(const std::filesystem::path& file, double recorded_Hz) {
  auto read = hal::read_recordings(file);
  REQUIRE(read);
  const Recording record = std::move(read).value().front();
  const double shaft_Hz = record.speed_rpm / 60;
  const BearingOrders orders = bearing_orders({9, 7.94, 39.04, 0});
  const auto candidate = [&](double order) {
    return CandidateLine{order * shaft_Hz, 0.01 * order * shaft_Hz};
  };
  return {shaft_Hz,
          compare_methods(record.channels[0].samples, recorded_Hz,
                          {candidate(orders.inner), candidate(orders.outer), candidate(orders.ball),
                           candidate(orders.cage), candidate(no_part)})};
}

}  // namespace

SCENARIO("four methods stand beside each other", "[analysis][envelope]") {
  GIVEN("a resonance at 2.9 kHz, struck 83 times a second, in noise") {
    const Eigen::VectorXd strikes = Strikes{rate_Hz, 83, 2900, 900, 0.003}.samples(32000);
    const Eigen::VectorXd x = strikes + test::rms(strikes) * white_noise(32000, 1);
    WHEN("83 Hz and 61 Hz are asked for") {
      const MethodComparison c = compare_methods(x, rate_Hz, {{83, 1}, {61, 1}});
      THEN("each method finds the former, none the latter") {
        for (const EnvelopeMethod method : envelope_methods) {
          CAPTURE(name_of(method));
          CHECK(c.found(0, method));
          CHECK_FALSE(c.found(1, method));
          const LineEvidence& line = evidence_of(c, 0, method).line;
          CHECK(line.p_value < 1e-3);
          CHECK(line.frequency == Approx(83).margin(0.5));
          CHECK(line.amplitude > line.threshold);
        }
        CHECK(c.share_of_emd() == 1);
      }
      THEN("each says where it looked") {
        const MethodEvidence& kurtogram = evidence_of(c, 0, EnvelopeMethod::kurtogram);
        CHECK(kurtogram.from < 2900);
        CHECK(kurtogram.to > 2900);
        CHECK(evidence_of(c, 0, EnvelopeMethod::emd).imf == 1);
        CHECK(evidence_of(c, 0, EnvelopeMethod::prewhitened).to == 4000);
      }
    }
  }
}

TEST_CASE("in noise each method finds a candidate as rarely as stated",
          "[analysis][envelope][null]") {
  if (test::too_long_under_sanitizer()) return;
  std::vector<NullDraws> draws(std::size(envelope_methods));
  int found = 0;
  constexpr int seeds = 150;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const MethodComparison c =
        compare_methods(white_noise(8192, seed), rate_Hz, {{83, 1}, {131, 3}},
                        {.false_alarm_rate = 0.05, .imfs = 4, .coherence_bands = 16});
    for (const EnvelopeMethod method : envelope_methods) {
      for (const std::size_t candidate : {0U, 1U}) {
        draws[static_cast<std::size_t>(method)].p_values.push_back(
            evidence_of(c, candidate, method).line.p_value);
        found += c.found(candidate, method) ? 1 : 0;
      }
    }
  }
  for (const EnvelopeMethod method : envelope_methods) {
    CAPTURE(name_of(method));
    CHECK_THAT(draws[static_cast<std::size_t>(method)], NoOftenerThanStated({0.01, 0.05, 0.2}));
  }
  const double asked = seeds * 2.0 * double(std::size(envelope_methods));
  CHECK(found <= 0.05 * asked + 4 * std::sqrt(0.05 * asked));
}

TEST_CASE("no candidate, no evidence, one out of range throws", "[analysis][envelope]") {
  const Eigen::VectorXd x = white_noise(4096, 1);
  CHECK(compare_methods(x, rate_Hz, {}).evidence.empty());
  CHECK(std::isnan(compare_methods(x, rate_Hz, {}).share_of_emd()));
  CHECK_THROWS_AS(compare_methods(x, rate_Hz, {{2100, 0}}), std::invalid_argument);
  CHECK_THROWS_AS(compare_methods(x, rate_Hz, {{0, 0}}), std::invalid_argument);
}

TEST_CASE("a spall of a race of the CWRU rig is found at its order, and no other",
          "[analysis][envelope][data]") {
  if (test::too_long_under_sanitizer()) return;
  const auto folder = test::data_folder();
  if (!folder) return;
  static constexpr std::size_t inner = 0, outer = 1, nothing = 4;
  const auto [file, race] = GENERATE(table<const char*, std::size_t>({
      {"cwru/IR007_0.mat", inner},
      {"cwru/IR021_0.mat", inner},
      {"cwru/OR007@6_0.mat", outer},
      {"cwru/OR021@6_0.mat", outer},
  }));
  CAPTURE(file);
  const Found found = in_recording(*folder / file, 12000);
  for (const EnvelopeMethod method : envelope_methods) {
    const LineEvidence& line = evidence_of(found.comparison, race, method).line;
    CAPTURE(name_of(method), line.p_value, line.frequency / found.shaft_Hz);
    CHECK(found.comparison.found(race, method));
    CHECK_FALSE(found.comparison.found(nothing, method));
  }
}

TEST_CASE("a sound bearing of the same rig is silent", "[analysis][envelope][data]") {
  const auto folder = test::data_folder();
  if (!folder) return;
  const Found found = in_recording(*folder / "cwru/normal_0.mat", 48000);
  for (const EnvelopeMethod method : envelope_methods) {
    for (const std::size_t candidate : {0U, 1U, 2U, 3U}) {
      const LineEvidence& line = evidence_of(found.comparison, candidate, method).line;
      CAPTURE(name_of(method), candidate, line.p_value, line.frequency / found.shaft_Hz);
      CHECK_FALSE(found.comparison.found(candidate, method));
    }
  }
}
