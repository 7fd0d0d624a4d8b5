#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <variant>

#include "analysis/station/control_chart.hpp"
#include "analysis/station/mls_interval.hpp"

namespace rvbench::analysis {

/// What values must stay between; one of them may be missing.
struct SpecificationLimits {
  std::optional<double> lower, upper;
};

/// An index with its interval.
struct CapabilityIndex {
  double value = 0;
  ConfidenceInterval interval;
};

/// How well a process fits between its limits.
struct Capability {
  std::optional<CapabilityIndex> cp;  ///< width over 6σ, σ of neighbours; of two limits only
  CapabilityIndex cpk;                ///< distance of the nearer limit over 3σ
  std::optional<CapabilityIndex> pp;  ///< the same by the standard deviation of all values
  CapabilityIndex ppk;
  double normality_p = 1;  ///< of values that are normal; see normality_p_value()
};

/// Below this p-value an index does not tell the share beyond a limit.
inline constexpr double least_normality_p = 0.05;

/// Cp, Cpk, Pp, Ppk with intervals. That of Pp is exact for normal values (chi-square):
///
///     Pp·√(χ²(α/2, ν)/ν) ... Pp·√(χ²(1-α/2, ν)/ν),   ν = n - 1
///     Ppk ± z·√(1/(9n) + Ppk²/(2ν))
///
/// those of Cp and Cpk take the ν that the mean range is worth, about 0.6·n, for its scatter is
/// larger and neighbours share a value.
///
/// Shape   least_baseline values or more, in the order of time
/// @return why there is none otherwise: a standard deviation, or an index, is no finite number
/// Errors  throws std::invalid_argument: fewer, one not finite or all alike, no limit, a lower one
///         not below the upper, confidence not within (0, 1)
/// Limits  of a process that is not in control, or not normal, no index says what will come
/// Source  Bissell, Appl. Stat. 39(3), 331-340 (1990), for Cpk; Montgomery, Introduction to
///         Statistical Quality Control, for Cp; ν of the mean range from E|xy| of correlated
///         normals
std::variant<Capability, std::string> capability_of(const Eigen::Ref<const Eigen::VectorXd>& values,
                                                    const SpecificationLimits& limits,
                                                    double confidence = 0.95);

}  // namespace rvbench::analysis
