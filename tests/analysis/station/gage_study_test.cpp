#include "analysis/station/gage_study.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/station/gage_anova.hpp"
#include "tests/support/gage_studies.hpp"

using namespace rvbench::analysis;
using Catch::Matchers::Contains;
using rvbench::test::aiag_study;
using rvbench::test::GageTruth;
using rvbench::test::simulated_study;

namespace {

GageStudy studied(const GageReadings& readings) {
  return std::get<GageStudy>(study_gage(readings));
}

bool holds(const ConfidenceInterval& interval, double value) {
  return interval.low <= value && value <= interval.high;
}

}  // namespace

TEST_CASE("the manual's worked example comes out to its printed digits",
          "[analysis][station][literature]") {
  const GageStudy study = studied(aiag_study());
  // The analysis of variance, as printed: appraisers, parts, their interaction, equipment.
  CHECK(study.anova.operators.sum_of_squares == Approx(3.1673).margin(5e-5));
  CHECK(study.anova.operators.mean_square() == Approx(1.58363).margin(5e-6));
  CHECK(study.anova.parts.sum_of_squares == Approx(88.3619).margin(5e-5));
  CHECK(study.anova.parts.mean_square() == Approx(9.81799).margin(5e-6));
  CHECK(study.anova.interaction.sum_of_squares == Approx(0.3590).margin(5e-5));
  CHECK(study.anova.interaction.mean_square() == Approx(0.01994).margin(5e-6));
  CHECK(study.anova.interaction.f == Approx(0.434).margin(5e-4));
  CHECK(study.anova.repeatability.sum_of_squares == Approx(2.7589).margin(5e-5));
  CHECK(study.anova.repeatability.mean_square() == Approx(0.04598).margin(5e-6));
  CHECK(study.anova.operators.freedom == 2);
  CHECK(study.anova.parts.freedom == 9);
  CHECK(study.anova.interaction.freedom == 18);
  CHECK(study.anova.repeatability.freedom == 60);
  // The interaction is far from significant, and pooled.
  CHECK(study.anova.is_pooled);
  CHECK(study.interaction.deviation == 0);
  CHECK(study.repeatability.deviation == Approx(0.199933).margin(5e-7));
  CHECK(study.operators.deviation == Approx(0.226838).margin(1e-6));
  CHECK(study.gage.deviation == Approx(0.30237).margin(5e-6));
  CHECK(study.parts.deviation == Approx(1.04233).margin(5e-6));
  CHECK(study.total == Approx(1.0853).margin(5e-5));
  CHECK(100 * study.share(study.repeatability) == Approx(18.4).margin(0.05));
  CHECK(100 * study.share(study.operators) == Approx(20.9).margin(0.05));
  CHECK(100 * study.gage_share == Approx(27.9).margin(0.05));
  CHECK(100 * study.share(study.parts) == Approx(96.0).margin(0.05));
  CHECK(study.categories == Approx(4.861).margin(1e-3));
  CHECK(study.distinct_categories() == 4);
}

TEST_CASE("the manual's example leaves three appraisers' spread wide open", "[analysis][station]") {
  const GageStudy study = studied(aiag_study());
  // Repeatability alone has an exact interval: 78 degrees of freedom, chi-square 55.466 and
  // 104.316.
  CHECK(study.repeatability.interval.low ==
        Approx(0.199933 * std::sqrt(78 / 104.316)).epsilon(1e-4));
  CHECK(study.repeatability.interval.high ==
        Approx(0.199933 * std::sqrt(78 / 55.466)).epsilon(1e-4));
  CHECK(study.operators.interval.high > 1);  // two degrees of freedom
  CHECK(study.operators.interval.low < 0.15);
  CHECK(holds(study.gage_share_interval, study.gage_share));
  CHECK(holds(study.categories_interval, study.categories));
  CHECK(study.gage_share_interval.high > 0.6);
  CHECK(share_of_tolerance(study.gage, 6) == Approx(study.gage.deviation));
}

TEST_CASE("a study of known components finds them", "[analysis][station]") {
  // So many operators that their estimate is as good as the others.
  const GageTruth truth{.parts = 2, .operators = 0.5, .interaction = 0.3, .repeatability = 0.2};
  const GageStudy study = studied(simulated_study(truth, 60, 60, 3, 5));
  CHECK_FALSE(study.anova.is_pooled);
  CHECK(study.anova.interaction.p_value < 1e-10);
  CHECK(study.parts.deviation == Approx(2).epsilon(0.3));
  CHECK(study.operators.deviation == Approx(0.5).epsilon(0.3));
  CHECK(study.interaction.deviation == Approx(0.3).epsilon(0.05));
  CHECK(study.repeatability.deviation == Approx(0.2).epsilon(0.05));
  CHECK(study.gage.deviation == Approx(std::sqrt(0.25 + 0.09 + 0.04)).epsilon(0.2));
  CHECK(study.total == Approx(std::hypot(study.gage.deviation, study.parts.deviation)));
}

TEST_CASE("intervals hold the truth about as often as they say", "[analysis][station]") {
  const GageTruth truth{.parts = 1, .operators = 0.2, .interaction = 0.15, .repeatability = 0.2};
  const double gage = std::sqrt(0.04 + 0.0225 + 0.04), share = gage / std::hypot(gage, 1);
  constexpr int studies = 100;
  int of_gage = 0, of_parts = 0, of_share = 0;
  for (unsigned seed = 0; seed < studies; ++seed) {
    const GageStudy study = studied(simulated_study(truth, 10, 4, 3, seed));
    of_gage += holds(study.gage.interval, gage) ? 1 : 0;
    of_parts += holds(study.parts.interval, 1) ? 1 : 0;
    of_share += holds(study.gage_share_interval, share) ? 1 : 0;
  }
  // 4 binomial standard deviations of 100 at 95 %.
  for (const int held : {of_gage, of_parts, of_share}) CHECK(held >= 0.86 * studies);
  // They are not so wide that they hold it always.
  CHECK(of_gage + of_parts + of_share < 3 * studies);
}

TEST_CASE("operators who are alike are not told apart", "[analysis][station][null]") {
  constexpr int studies = 1000;
  int told = 0, pooled = 0;
  for (unsigned seed = 0; seed < studies; ++seed) {
    const GageAnova anova = anova_of(simulated_study({}, 10, 3, 3, 100 + seed));
    told += anova.operators.p_value < 0.05 ? 1 : 0;
    pooled += anova.is_pooled ? 1 : 0;
  }
  // 5 % and 75 %, give or take 4 binomial standard deviations.
  CHECK(told < studies * 0.05 + 4 * std::sqrt(studies * 0.05 * 0.95));
  CHECK(told > 0);
  CHECK(pooled == Approx(0.75 * studies).margin(4 * std::sqrt(studies * 0.75 * 0.25)));
}

TEST_CASE("a study knows neither unit nor offset", "[analysis][station]") {
  GageReadings readings = aiag_study();
  const GageStudy before = studied(readings);
  for (double& value : readings.values) value = 1e-3 * value + 7;
  const GageStudy after = studied(readings);
  CHECK(after.gage.deviation == Approx(1e-3 * before.gage.deviation));
  CHECK(after.gage_share == Approx(before.gage_share));
  CHECK(after.categories_interval.low == Approx(before.categories_interval.low));
}

TEST_CASE("parts that are all alike make one category", "[analysis][station]") {
  const GageStudy study = studied(simulated_study({.parts = 0}, 10, 3, 3, 4));
  CHECK(study.distinct_categories() == 1);
  CHECK(study.gage_share > 0.9);
  CHECK(study.gage_share_interval.high == Approx(1).margin(0.01));
}

TEST_CASE("a study whose numbers overflow or vanish says nothing", "[analysis][station]") {
  const double factor = GENERATE(1e300, 1e100, 1e-100);
  GageReadings readings = aiag_study();
  for (double& value : readings.values) value *= factor;
  CHECK_THAT(std::get<std::string>(study_gage(readings)), Contains("cannot tell"));
}

TEST_CASE("parts may be farther apart than categories are counted", "[analysis][station]") {
  GageReadings readings{2, 2, 2, {1, 1 + 1e-15, 1, 1, 1e30, 1e30, 1e30, 1e30}};
  CHECK(studied(readings).distinct_categories() == 1'000'000'000);
}

TEST_CASE("readings that never differ say nothing of the gage", "[analysis][station]") {
  GageReadings readings{2, 2, 2, {1, 1, 1, 1, 2, 2, 2, 2}};
  CHECK_THAT(std::get<std::string>(study_gage(readings)), Contains("too coarse"));
  // Nor where the mean of equal readings would be off by its last digit.
  for (const std::size_t trials : {6U, 7U, 10U}) {
    GageReadings copied{2, 2, trials, {}};
    for (const double value : {0.1, 0.3, 0.7, 1.1}) {
      copied.values.insert(copied.values.end(), trials, value);
    }
    CHECK_THAT(std::get<std::string>(study_gage(copied)), Contains("too coarse"));
  }
  readings.values.pop_back();
  CHECK_THROWS_AS(study_gage(readings), std::invalid_argument);
  CHECK_THROWS_AS(study_gage({1, 2, 2, {1, 2, 3, 4}}), std::invalid_argument);
  CHECK_THROWS_AS(share_of_tolerance({}, 0), std::invalid_argument);
}
