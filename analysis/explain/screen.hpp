#pragma once

#include <vector>

#include "analysis/explain/fit.hpp"
#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// What a candidate could do for a fit, to first order.
struct Screened {
  std::size_t effect = 0;
  double explains = 0;     ///< share of what the fit leaves over, 0 to 1
  double p_value = 1;      ///< of that being chance, by the scatter from unit to unit
  Eigen::VectorXd scores;  ///< of each unit: its part in it
  /// Unit length: the candidate's own mark on the residuals, then on what is known beforehand.
  Eigen::VectorXd direction;
  /// Its values where it explains that; empty if it leaves no small mark, or if one with far starts
  /// would have to be out of bounds for it: then a large one may be elsewhere.
  std::vector<double> start;
  bool is_admissible = true;  ///< false: its one size would have to be out of bounds for it
};

/// How the residuals change with each candidate's size, as a fit found them: per candidate and
/// start; empty where the model cannot be evaluated.
using Marks = std::vector<std::vector<Eigen::VectorXd>>;

/// Score test of every candidate that the data can show and the fit does not hold yet, strongest
/// first. What base and accepted effects can do within what is known of them is projected out: a
/// candidate is credited only with what they cannot.
///
/// A candidate's shape parameters stay at each of its starts in turn; the best one counts.
/// Units   shares and p-values; starts in those of the parameters. Errors  none thrown
/// Source  Rao, Proc. Camb. Phil. Soc. 44, 50-57 (1948)
///
/// @param marks  those of a fit with fewer effects: of the candidates that explain most by them
///               marks are found anew, the others are left out; empty: filled with all of this fit
std::vector<Screened> screen(const ForwardModel& model, const Fit& fit,
                             const std::vector<bool>& trained, Marks& marks);

/// How much of what the last effect of a fit does, beyond what the base can do, each of the others
/// could do as well: 0 to 1, as the slopes have it; 0 of one that changes the structure.
/// Shape   one per other effect, in the fit's order. Errors  none thrown: the fit has an effect
/// Source  ours: share of a projection, as a coefficient of determination
std::vector<double> done_by_others(const ForwardModel& model, const Fit& fit);

/// Share of what the fit leaves over that two candidates explain together, 0 to 1.
/// Errors  none thrown. Source  Draper & Smith, Applied Regression Analysis (1998): two regressors
double pair_explains(const Screened& a, const Screened& b);

/// Whether neither would have to be out of its bounds for that.
/// Errors  none thrown. Source  of pair_explains()
bool pair_is_admissible(const ForwardModel& model, const Screened& a, const Screened& b);

/// Probability that two candidates together explain this much by chance, by the scatter of their
/// scores from unit to unit.
/// Errors  none thrown; 1 for fewer than four units
/// Source  Hotelling, Ann. Math. Stat. 2(3), 360-378 (1931)
double pair_p_value(const Screened& a, const Screened& b);

}  // namespace rvbench::analysis
