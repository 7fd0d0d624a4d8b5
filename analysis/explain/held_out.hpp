#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Units below which there is too little to leave any out.
inline constexpr std::size_t fewest_units = 8;

/// One thing left out: per unit, whether it is.
struct Fold {
  std::string left_out;
  std::vector<bool> held_out;
  /// Whether the others lie to one side of it: what they leave open of the numbers makes it less
  /// sure what it shows.
  bool is_beyond = false;
  std::vector<bool> trained() const;  ///< the others
};

/// A fold for each condition. Of fewer than five, where some were recorded more than once, a fold
/// for each record: what shows under one of few conditions alone cannot be learned from the others.
/// Empty if there is only one.
/// Errors  none thrown. Source  Stone, J. R. Stat. Soc. B 36(2), 111-147 (1974), by conditions
std::vector<Fold> condition_folds(const std::vector<ObservedUnit>& units);

/// A fold for each speed. Empty if there are fewer than three of them.
/// Errors, source  of condition_folds()
std::vector<Fold> speed_folds(const std::vector<ObservedUnit>& units);

/// The same for each load. Errors, source  of condition_folds()
std::vector<Fold> load_folds(const std::vector<ObservedUnit>& units);

/// Both of them, speeds first: what holds between conditions must hold beyond them, too.
/// Errors, source  of condition_folds()
std::vector<Fold> extrapolation_folds(const std::vector<ObservedUnit>& units);

/// How well a model predicts what it has not seen.
struct HeldOut {
  std::vector<std::size_t> effects;
  /// Per fold and unit held out there, in order: log density of its values.
  Eigen::VectorXd log_density;
  double rms = 0;  ///< of all their residuals
  /// Per fold: the sum of their squares, and how many there are.
  std::vector<double> square_sums = {}, counts = {};
  /// Per fold: the sum of squares to be expected of residuals that scatter by one where they were
  /// learned from; of a fold that is beyond, with what is left open of the numbers.
  std::vector<double> expected_sums = {};
  /// Of the residuals of some folds in a row.
  double rms_of(std::size_t first_fold, std::size_t folds) const;
  /// What that would be with a scatter of one.
  double expected_of(std::size_t first_fold, std::size_t folds) const;
};

/// How a fit without a fold is come by.
enum class LeftOut {
  forecast,  ///< from the slopes of the whole fit: nothing is evaluated; of a quick model refitted
  refitted
};

/// Fits anew without each fold, starting where `fit` ended, and predicts the fold.
///
/// The density is normal with the scatter of the units learned from; of a fold that is beyond them,
/// also with what they leave open of the numbers, as straight as the fit's slopes.
/// @param counts_as  how many independent values one value of a unit is worth, in (0, 1]; the same
///                   for all models that are compared
/// @return nothing if the model cannot be evaluated in a fold
/// Shape, units  one log density, in nats, per fold and unit held out. Errors  none thrown
/// Source  Stone (1974); log density as a score: Gneiting & Raftery, J. Am. Stat. Assoc. 102,
///         359-378 (2007)
std::optional<HeldOut> predict_held_out(const ForwardModel& model, const Fit& fit,
                                        const std::vector<Fold>& folds, double counts_as,
                                        LeftOut left_out);

/// Log density of a unit's residuals, normal with this mean square.
/// Units   nats. Errors  none thrown. Source  the normal density; Gneiting & Raftery (2007)
double log_density_of(const Eigen::Ref<const Eigen::VectorXd>& residuals, double mean_square,
                      double counts_as);

/// What a value is worth where neighbours correlate by ρ: (1 − ρ)/(1 + ρ).
/// Errors  none thrown. Source  Bayley & Hammersley, Suppl. J. R. Stat. Soc. 8(2), 184-197 (1946)
double independent_share(const ForwardModel& model, const Eigen::VectorXd& residuals);

/// By how much one model predicts better than another: the sum over all predictions, and its
/// standard error by the scatter from unit to unit.
struct Margin {
  double delta = 0;  ///< log density, nats
  double se = 0;
  bool is_clear() const { return delta > 2 * se; }
};

/// Of two models on the same folds.
/// @throws std::invalid_argument if the two were not predicted on the same folds
/// Source  Vehtari, Gelman & Gabry, Stat. Comput. 27, 1413-1432 (2017): its standard error
Margin margin(const HeldOut& better, const HeldOut& than);

/// In how many of `count` draws of the units, with replacement, each model predicts best.
/// Deterministic. @return shares, one for each model
/// Errors  none thrown; all were predicted on the same folds
/// Source  Efron, Ann. Stat. 7(1), 1-26 (1979): the bootstrap
std::vector<double> shares_won(const std::vector<HeldOut>& models, int count = 200);

}  // namespace rvbench::analysis
