#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "analysis/explain/descent.hpp"
#include "analysis/explain/settle.hpp"

namespace rvbench::analysis {

/// A model with some effects added, and where its parameters came to rest.
struct Fit {
  std::vector<std::size_t> effects;  ///< indices into the model's library
  std::vector<double> values;        ///< of the base, then of each effect
  Eigen::VectorXd residuals;         ///< of all units, learned from or not
  Eigen::MatrixXd slopes;            ///< d residuals / d values
  Eigen::MatrixXd covariance;        ///< of as_waves(values), clustered by unit
  double freedom = 1;                ///< units, less the numbers that were learned from them
  double cost = 0;                   ///< sum of squares over the units learned from
  double scatter = 1;                ///< see FitProblem: what it was fitted with
  std::string not_certified;         ///< why it must not be ranked; empty if several starts agree
};

/// Costs that a fit is measured by: above the first two it is not worth going on with.
struct MustBeat {
  /// Of the best start after the first moves.
  double after_first_moves = std::numeric_limits<double>::infinity();
  /// Of the best one once the first has come to rest.
  double at_rest = std::numeric_limits<double>::infinity();
  /// Of the model that it adds to: what it gains over it is what its starts must agree about.
  double before = 0;
};

/// Least squares by simulation, from several starts.
///
/// The fit moves the base and every effect together. It is certified if at least two starts end
/// within 1e-4 in cost, or one value's share of it, or a tenth of what is gained, and, of each
/// parameter of the last effect but phases, within 5 %, an angle within 0.05 rad, or a tenth of its
/// standard error. All starts make their first moves; the best three go on until two come to rest
/// in one place.
///
/// Units       those of the parameters; residuals as the model has them
/// Errors      none thrown: what must not be ranked says so in not_certified
/// Covariance  (JᵀJ)⁻¹ (Σ_u g_u g_uᵀ) (JᵀJ)⁻¹ with g_u = J_uᵀ r_u: dependence within a unit does
///             not count as knowledge
/// Source      Liang & Zeger, Biometrika 73(1), 13-22 (1986)
///
/// @param starts     each of the size of all values; the best end wins
/// @param trained    per unit: whether it is learned from
/// @param held       slopes of the first parameters, good enough to be ranked by: see polish()
/// @param must_beat  where no start comes below it the fit ends there, without residuals
/// @param scatter    of residuals: see FitProblem
Fit fit_from(const ForwardModel& model, const std::vector<std::size_t>& effects,
             std::vector<std::vector<double>> starts, const std::vector<bool>& trained,
             double scatter = 1, const Eigen::MatrixXd& held = {}, const MustBeat& must_beat = {});

/// Where fits begin that add to another: its values, then each of `all_own` in turn.
/// Shape   one start per own one. Errors  none thrown. Source  ours
std::vector<std::vector<double>> starts_from(const std::vector<double>& before,
                                             const std::vector<std::vector<double>>& all_own);

/// The fit of `before` with `added` as one more effect, from that effect's own starts.
/// @param screened  one more start, or, of an effect with far starts, the only one: see Screened;
///                  may be empty
/// Units, source  of fit_from()
/// @throws std::out_of_range if the library has no such effect
Fit fit_with(const ForwardModel& model, const Fit& before, std::size_t added,
             const std::vector<bool>& trained, const MustBeat& must_beat = {},
             const std::vector<double>& screened = {});

/// Goes to rest with all slopes looked for anew, and with the scatter that the residuals have
/// there: a fit that was ranked with slopes held, and with the scatter of a poorer model.
/// @param before  cost of the model that it adds to: a step that wins hardly anything of what was
///                gained over it is the last one; 0 goes as far as differences are exact
/// @return with the certificate that it had, or the reason why it has lost it
/// Units, errors, source  of fit_from()
Fit polish(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained,
           double before = 0);

/// Where its slopes say that a fit would come to rest on other units; of a quick model, see
/// refit().
/// Units, errors, source  of forecast()
Evaluated foresee(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained);

/// Where a fit comes to rest on other units, without a certificate.
/// Units   of fit_from(). Errors  none thrown; no residuals where it fails. Source  of settle()
Evaluated refit(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained);

/// Where the values of one of the effects begin, after those of the base and of the effects before.
/// @param place  of the effect in `effects`
/// Errors  none thrown: a place that is not there is the caller's bug
std::size_t first_value_of(const ForwardModel& model, const std::vector<std::size_t>& effects,
                           std::size_t place);

}  // namespace rvbench::analysis
