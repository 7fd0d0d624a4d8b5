#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "analysis/station/mls_interval.hpp"

namespace rvbench::analysis {

/// Readings of a crossed, balanced study: each operator reads each part equally often.
struct GageReadings {
  std::size_t parts = 0, operators = 0, trials = 0;  ///< each 2 or more
  std::vector<double> values;  ///< parts·operators·trials of them: part slowest, trial fastest

  double at(std::size_t part, std::size_t op, std::size_t trial) const {
    return values[(part * operators + op) * trials + trial];
  }
};

/// One line of an analysis of variance.
struct AnovaLine {
  double sum_of_squares = 0;
  double freedom = 0;
  double f = 0;        ///< against the line that has what this one has but for its own effect; 0 of
                       ///< repeatability
  double p_value = 1;  ///< of no such effect

  double mean_square() const { return sum_of_squares / freedom; }
};

struct GageAnova {
  AnovaLine parts, operators, interaction, repeatability;  ///< as measured, nothing pooled
  bool is_pooled = false;  ///< interaction and repeatability are one, for p is above pooling_p

  AnovaLine error() const;  ///< what repeatability is taken from
};

/// A standard deviation that makes up part of what readings differ by.
struct GageComponent {
  double deviation = 0;         ///< in the unit of the readings; 0 where the estimate is below
  ConfidenceInterval interval;  ///< of the deviation
};

/// What a gage adds to what it measures.
struct GageStudy {
  GageAnova anova;
  GageComponent repeatability;  ///< EV: one operator, one part, again
  GageComponent operators;      ///< AV: between operators
  GageComponent interaction;    ///< of operators with parts; 0 where pooled
  GageComponent gage;           ///< GRR: all of these together
  GageComponent parts;          ///< PV: between parts
  double total = 0;             ///< TV: gage and parts
  double gage_share = 0;        ///< %GRR: GRR/TV, 0 to 1
  ConfidenceInterval gage_share_interval;
  double categories = 0;  ///< ndc before it is rounded down: 1.41·PV/GRR
  ConfidenceInterval categories_interval;

  double share(const GageComponent& component) const { return component.deviation / total; }
  int distinct_categories() const;  ///< ndc: 1 at least
};

/// 6·GRR of the width between both limits, 0.1 for a tenth: %tolerance.
/// @throws std::invalid_argument if the tolerance is not above 0
double share_of_tolerance(const GageComponent& component, double tolerance);

/// How large p must be for the interaction to be taken as none.
inline constexpr double pooling_p = 0.25;

/// Gage repeatability and reproducibility by analysis of variance, all effects random:
///
///     EV² = M_E,  INT² = (M_OP - M_E)/r,  AV² = (M_O - M_OP)/(p·r),  PV² = (M_P - M_OP)/(o·r)
///
/// p parts, o operators, r trials; where the interaction is pooled M_OP is M_E, of both together.
/// Estimates below 0 are 0.
///
/// @param confidence  of the intervals
/// @return why there is none otherwise: each operator reads each part alike every time, or a
///         result is no finite number or the product of two mean squares not within what numbers
///         hold
/// @throws std::invalid_argument if sizes do not fit, are below 2, or a value is not finite
/// Limits  intervals by mls_interval(), of %GRR and ndc by the λ for which PV² - λ·GRR² may be 0;
///         three operators say little of all operators: the interval of AV is wide, and honest
/// Source  AIAG, Measurement Systems Analysis, 4th ed. (2010), ch. III; Burdick, Borror &
///         Montgomery, Design and Analysis of Gauge R&R Studies (2005)
std::variant<GageStudy, std::string> study_gage(const GageReadings& readings,
                                                double confidence = 0.95);

}  // namespace rvbench::analysis
