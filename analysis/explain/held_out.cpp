#include "analysis/explain/held_out.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <random>
#include <set>
#include <stdexcept>

#include "analysis/explain/fit_problem.hpp"
#include "hal/types/linear_algebra.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest_to_leave_one_out = 3;
constexpr std::size_t fewest_conditions = 5;  // with fewer, one left out is beyond the others

std::vector<Fold> folds_of(const std::vector<ObservedUnit>& units, std::string ObservedUnit::*label,
                           std::size_t fewest) {
  std::vector<Fold> folds;
  std::set<std::string> names;
  for (const ObservedUnit& unit : units) names.insert(unit.*label);
  if (names.size() < fewest) return folds;
  for (const std::string& name : names) {
    Fold fold{name, {}};
    for (const ObservedUnit& unit : units) fold.held_out.push_back(unit.*label == name);
    folds.push_back(std::move(fold));
  }
  return folds;
}

// What the units learned from leave open of the numbers: by it, a prediction is less sure.
class Open {
 public:
  Open(const FitProblem& on, const Eigen::MatrixXd& slopes) {
    if (slopes.cols() == 0 || slopes.cols() != Eigen::Index(on.parameters.size())) return;
    const Eigen::MatrixXd learned = information_of(on, slopes);
    Eigen::VectorXd even = learned.diagonal() + slopes.colwise().squaredNorm().transpose();
    even = (even.array() > 0).select(even.cwiseSqrt().cwiseInverse(), 1.0);
    slopes_ = slopes * even.asDiagonal();
    learned_ = even.asDiagonal() * learned * even.asDiagonal();
    learned_.diagonal().array() += not_told;
    log_volume_ = algebra::SymmetricFactors(learned_).log_determinant();
  }

  // By how much the numbers add to the sum of squares of a unit's residuals that scatter by one.
  double expected_more(const ObservedUnit& unit, double counts_as) const {
    if (learned_.size() == 0) return 0;
    const auto j = slopes_.middleRows(unit.first, unit.size);
    const algebra::SymmetricFactors learned(learned_);
    return (j * learned.solve(Eigen::MatrixXd(j.transpose()))).trace() / counts_as;
  }

  // What the log density of a unit's residuals gains by it over one with all numbers known.
  double gain(const ObservedUnit& unit, const Eigen::VectorXd& residuals, double mean_square,
              double counts_as) const {
    if (learned_.size() == 0) return 0;
    const auto j = slopes_.middleRows(unit.first, unit.size);
    const algebra::SymmetricFactors with(learned_ + algebra::gram(j));
    const Eigen::VectorXd gradient = j.transpose() * residuals.segment(unit.first, unit.size);
    return 0.5 * (counts_as / mean_square * gradient.dot(with.solve(gradient)) -
                  (with.log_determinant() - log_volume_));
  }

 private:
  static constexpr double not_told = 1e-10;  // of what all units tell of a number

  Eigen::MatrixXd slopes_, learned_;
  double log_volume_ = 0;
};

// Over some folds in a row.
double root_mean(const std::vector<double>& sums, const std::vector<double>& counts,
                 std::size_t first, std::size_t folds) {
  double sum = 0, values = 0;
  for (std::size_t i = first; i < first + folds; ++i) {
    sum += sums[i];
    values += counts[i];
  }
  return values > 0 ? std::sqrt(sum / values) : 0;
}

}  // namespace

std::vector<bool> Fold::trained() const {
  std::vector<bool> others = held_out;
  others.flip();
  return others;
}

std::vector<Fold> condition_folds(const std::vector<ObservedUnit>& units) {
  std::vector<Fold> conditions = folds_of(units, &ObservedUnit::condition, 2);
  if (conditions.empty() || conditions.size() >= fewest_conditions) return conditions;
  std::vector<Fold> records = folds_of(units, &ObservedUnit::record, 2);
  return records.size() > conditions.size() ? records : conditions;
}

std::vector<Fold> speed_folds(const std::vector<ObservedUnit>& units) {
  return folds_of(units, &ObservedUnit::speed, fewest_to_leave_one_out);
}

std::vector<Fold> load_folds(const std::vector<ObservedUnit>& units) {
  return folds_of(units, &ObservedUnit::load, fewest_to_leave_one_out);
}

std::vector<Fold> extrapolation_folds(const std::vector<ObservedUnit>& units) {
  std::vector<Fold> folds = speed_folds(units);
  std::ranges::move(load_folds(units), std::back_inserter(folds));
  for (Fold& fold : folds) fold.is_beyond = true;
  return folds;
}

double HeldOut::rms_of(std::size_t first_fold, std::size_t folds) const {
  return root_mean(square_sums, counts, first_fold, folds);
}

double HeldOut::expected_of(std::size_t first_fold, std::size_t folds) const {
  return root_mean(expected_sums, counts, first_fold, folds);
}

double log_density_of(const Eigen::Ref<const Eigen::VectorXd>& residuals, double mean_square,
                      double counts_as) {
  const auto size = static_cast<double>(residuals.size());
  return -0.5 * std::max(size * counts_as, 1.0) *
         (std::log(2 * std::numbers::pi * mean_square) +
          residuals.squaredNorm() / size / mean_square);
}

double independent_share(const ForwardModel& model, const Eigen::VectorXd& residuals) {
  double product = 0, power = 0;
  for (const ObservedUnit& unit : model.units()) {
    const auto r = residuals.segment(unit.first, unit.size);
    power += r.squaredNorm();
    if (unit.size > 1) product += r.head(unit.size - 1).dot(r.tail(unit.size - 1));
  }
  const double rho = power > 0 ? std::clamp(product / power, 0.0, 0.999) : 0.0;
  return (1 - rho) / (1 + rho);
}

std::optional<HeldOut> predict_held_out(const ForwardModel& model, const Fit& fit,
                                        const std::vector<Fold>& folds, double counts_as,
                                        LeftOut left_out) {
  std::vector<Evaluated> without(folds.size());
  parallel_for(folds.size(), [&](std::size_t i) {
    const std::vector<bool> trained = folds[i].trained();
    without[i] =
        left_out == LeftOut::refitted ? refit(model, fit, trained) : foresee(model, fit, trained);
  });
  HeldOut result{fit.effects, {}, 0};
  std::vector<double> densities;
  for (std::size_t i = 0; i < folds.size(); ++i) {
    double sum = 0, values = 0, expected = 0;
    const Eigen::VectorXd& all = without[i].residuals;
    if (all.size() == 0) return std::nullopt;
    const std::vector<bool> trained = folds[i].trained();
    const double scatter = std::max(mean_square_of(model, all, trained), model.least_mean_square());
    std::optional<Open> open;
    if (folds[i].is_beyond) {
      open.emplace(FitProblem(model, fit.effects, trained, fit.scatter), fit.slopes);
    }
    for (std::size_t u = 0; u < folds[i].held_out.size(); ++u) {
      if (!folds[i].held_out[u]) continue;
      const ObservedUnit& unit = model.units()[u];
      const auto residuals = all.segment(unit.first, unit.size);
      densities.push_back(log_density_of(residuals, scatter, counts_as));
      if (open) densities.back() += open->gain(unit, all, scatter, counts_as);
      sum += residuals.squaredNorm();
      values += static_cast<double>(unit.size);
      expected +=
          static_cast<double>(unit.size) + (open ? open->expected_more(unit, counts_as) : 0);
    }
    result.expected_sums.push_back(expected);
    result.square_sums.push_back(sum);
    result.counts.push_back(values);
  }
  result.log_density =
      Eigen::Map<Eigen::VectorXd>(densities.data(), Eigen::Index(densities.size()));
  result.rms = result.rms_of(0, folds.size());
  return result;
}

Margin margin(const HeldOut& better, const HeldOut& than) {
  if (better.log_density.size() != than.log_density.size()) {
    throw std::invalid_argument("margin: models were predicted on different folds");
  }
  const Eigen::ArrayXd apart = better.log_density - than.log_density;
  const auto n = static_cast<double>(apart.size());
  if (n < 2) return {apart.sum(), std::numeric_limits<double>::infinity()};
  const double variance = (apart - apart.mean()).square().sum() / (n - 1);
  return {apart.sum(), std::sqrt(n * variance)};
}

std::vector<double> shares_won(const std::vector<HeldOut>& models, int count) {
  std::vector<double> shares(models.size(), 0.0);
  if (models.empty()) return shares;
  const Eigen::Index n = models.front().log_density.size();
  std::mt19937_64 engine(1);  // NOLINT(cert-msc51-cpp): the same data give the same shares
  for (int i = 0; i < count; ++i) {
    Eigen::VectorXd times = Eigen::VectorXd::Zero(n);
    for (Eigen::Index k = 0; k < n; ++k)
      times[static_cast<Eigen::Index>(engine() % static_cast<std::uint64_t>(n))] += 1;
    std::vector<double> sums;
    for (const HeldOut& model : models) sums.push_back(times.dot(model.log_density));
    ++shares[static_cast<std::size_t>(std::ranges::max_element(sums) - sums.begin())];
  }
  for (double& share : shares) share /= count;
  return shares;
}

}  // namespace rvbench::analysis
