#include "analysis/station/gage_study.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/station/gage_anova.hpp"
#include "analysis/station/not_finite.hpp"
#include "analysis/station/rising_root.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr double categories_per_ratio = 1.41;  // as the manual has it, in place of √2
constexpr double study_deviations = 6;

using Terms = std::vector<MeanSquareTerm>;

double deviation(double variance) { return std::sqrt(std::max(variance, 0.0)); }

// Each component as a sum of mean squares, by the expected ones.
class Components {
 public:
  Components(const GageReadings& readings, const GageAnova& anova)
      : p_(double(readings.parts)),
        o_(double(readings.operators)),
        r_(double(readings.trials)),
        anova_(anova),
        cell_(anova.is_pooled ? anova.error() : anova.interaction) {}

  Terms repeatability() const { return {term(1, anova_.error())}; }
  Terms operators() const {
    return {term(1 / (p_ * r_), anova_.operators), term(-1 / (p_ * r_), cell_)};
  }
  Terms interaction() const { return {term(1 / r_, cell_), term(-1 / r_, anova_.repeatability)}; }
  Terms parts() const { return {term(1 / (o_ * r_), anova_.parts), term(-1 / (o_ * r_), cell_)}; }
  Terms gage() const {
    if (anova_.is_pooled) {
      return {term(1 / (p_ * r_), anova_.operators), term(1 - 1 / (p_ * r_), cell_)};
    }
    return {term(1 / (p_ * r_), anova_.operators), term((p_ - 1) / (p_ * r_), cell_),
            term((r_ - 1) / r_, anova_.repeatability)};
  }
  // PV² - λ·GRR², each mean square once.
  Terms parts_less_gage(double lambda) const {
    Terms terms = gage();
    for (MeanSquareTerm& t : terms) t.coefficient *= -lambda;
    const Terms of_parts = parts();
    terms[1].coefficient += of_parts[1].coefficient;
    terms.push_back(of_parts[0]);
    return terms;
  }

 private:
  static MeanSquareTerm term(double coefficient, const AnovaLine& line) {
    return {coefficient, line.mean_square(), line.freedom};
  }

  double p_, o_, r_;
  const GageAnova& anova_;
  AnovaLine cell_;  // what parts and operators are held against
};

double sum_of(const Terms& terms) {
  double sum = 0;
  for (const MeanSquareTerm& t : terms) sum += t.coefficient * t.mean_square;
  return sum;
}

GageComponent component(const Terms& terms, double confidence) {
  const ConfidenceInterval variance = mls_interval(terms, confidence);
  return {deviation(sum_of(terms)), {deviation(variance.low), deviation(variance.high)}};
}

// Of PV²/GRR²: what λ may be.
ConfidenceInterval ratio_interval(const Components& components, double confidence) {
  const auto end = [&](bool low) {
    // Of -(PV² - λ·GRR²), which rises with λ.
    const auto rising = [&](double lambda) {
      const auto interval = mls_interval(components.parts_less_gage(lambda), confidence);
      return -(low ? interval.low : interval.high);
    };
    return rising(0) >= 0 ? 0 : rising_root(rising, 0, 0, 1, 1e-6);
  };
  return {end(true), end(false)};
}

double share_of_ratio(double ratio) { return 1 / std::sqrt(1 + ratio); }
double categories_of_ratio(double ratio) { return categories_per_ratio * std::sqrt(ratio); }

void check(const GageReadings& readings, double confidence) {
  constexpr Require require{"study_gage"};
  require(readings.parts >= 2 && readings.operators >= 2 && readings.trials >= 2,
          "needs 2 parts, operators and trials or more");
  require(readings.values.size() == readings.parts * readings.operators * readings.trials,
          "not as many values as parts x operators x trials");
  require(std::ranges::all_of(readings.values, [](double v) { return std::isfinite(v); }),
          "a value is not finite");
  require(confidence > 0 && confidence < 1, "the confidence is a share between 0 and 1");
}

// Intervals take products of two mean squares, which may neither overflow nor vanish.
bool have_products(const GageAnova& anova) {
  const auto has_product = [](const AnovaLine& line) {
    const double product = line.mean_square() * line.mean_square();
    return line.sum_of_squares == 0 || std::isnormal(product);
  };
  return has_product(anova.parts) && has_product(anova.operators) &&
         has_product(anova.interaction) && has_product(anova.repeatability);
}

bool is_finite(const GageComponent& c) {
  return are_finite({c.deviation, c.interval.low, c.interval.high});
}

bool is_finite(const GageStudy& study) {
  const GageAnova& anova = study.anova;
  return are_finite({anova.parts.f, anova.operators.f, anova.interaction.f, anova.parts.p_value,
                     anova.operators.p_value, anova.interaction.p_value, study.total,
                     study.gage_share, study.gage_share_interval.low,
                     study.gage_share_interval.high, study.categories,
                     study.categories_interval.low, study.categories_interval.high}) &&
         is_finite(study.repeatability) && is_finite(study.operators) &&
         is_finite(study.interaction) && is_finite(study.gage) && is_finite(study.parts);
}

}  // namespace

int GageStudy::distinct_categories() const { return int(std::clamp(categories, 1.0, 1e9)); }

double share_of_tolerance(const GageComponent& component, double tolerance) {
  constexpr Require require{"share_of_tolerance"};
  require(tolerance > 0, "the tolerance is above 0");
  return study_deviations * component.deviation / tolerance;
}

std::variant<GageStudy, std::string> study_gage(const GageReadings& readings, double confidence) {
  check(readings, confidence);
  GageStudy study;
  study.anova = anova_of(readings);
  if (study.anova.repeatability.sum_of_squares == 0) {
    return "every operator reads every part alike each time: the readings are too coarse to tell "
           "the gage's error, or were copied";
  }
  if (!have_products(study.anova)) {
    return "cannot tell: the readings are too large, too far apart or too near to each other for "
           "products of their mean squares";
  }
  const Components components(readings, study.anova);
  study.repeatability = component(components.repeatability(), confidence);
  study.operators = component(components.operators(), confidence);
  if (!study.anova.is_pooled) {
    study.interaction = component(components.interaction(), confidence);
  }
  study.parts = component(components.parts(), confidence);
  // Of what is left of the components: one below 0 takes nothing from the others.
  study.gage.deviation = std::hypot(study.repeatability.deviation, study.operators.deviation,
                                    study.interaction.deviation);
  study.gage.interval = component(components.gage(), confidence).interval;
  study.total = std::hypot(study.gage.deviation, study.parts.deviation);

  const double ratio = std::pow(study.parts.deviation / study.gage.deviation, 2);
  const ConfidenceInterval ratios = ratio_interval(components, confidence);
  study.gage_share = share_of_ratio(ratio);
  study.gage_share_interval = {share_of_ratio(ratios.high), share_of_ratio(ratios.low)};
  study.categories = categories_of_ratio(ratio);
  study.categories_interval = {categories_of_ratio(ratios.low), categories_of_ratio(ratios.high)};
  if (!is_finite(study)) return not_finite("a result");
  return study;
}

}  // namespace rvbench::analysis
