#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "analysis/station/tolerance_factor.hpp"

namespace rvbench::analysis {

enum class LimitSide { max, min };

/// A limit that good units have taught, and what it rests on.
struct RobustLimit {
  std::size_t units = 0;
  double median = 0;
  double mad = 0;                      ///< median of |x - median|
  double factor = 0;                   ///< k
  double limit = 0;                    ///< median ± k·1.4826·MAD
  std::vector<std::size_t> set_aside;  ///< indices of units that are unlike the others, in order
};

/// The fewest units a limit is taken from: of fewer the factor is above 6, twice what it is where
/// the population is known, and three bad ones among them are too many.
inline constexpr std::size_t least_units_of_a_limit = 20;

/// The k for which median + k·1.4826·MAD of n units is a limit of that coverage, if the good ones
/// are normal. Found by simulation: it is the confidence's quantile of
///
///     (z - median)/(1.4826·MAD)
///
/// in 20 000 samples of n normal values, each treated as robust_limit() treats units, by a fixed
/// seed. Beyond 100 units what it is above the content's quantile z falls as 1/√n.
///
/// @throws std::invalid_argument below least_units_of_a_limit, or for content or confidence not
///         within (0.5, 1)
/// Limits  simulated to 0.3 %; content above 0.9999 rests on the normal shape of the tail, which no
///         such number of units can show
/// Source  definition of a tolerance limit: Krishnamoorthy & Mathew, Statistical Tolerance Regions
///         (2009), ch. 1; of the robust estimates: Huber, Robust Statistics (1981), ch. 6
double robust_tolerance_factor(std::size_t units, const Coverage& coverage);

/// A limit from units that are good but for a few: those further than 3 robust standard deviations
/// from the median are set aside, of the others median and MAD make the limit.
///
/// Shape   one value a unit. Units  of the values
/// Limits  3 bad units among 50 widen the distance from a typical unit to the limit by 9.5, 7.5,
///         4.3, 1.5 and 0.3 % on average where they are 2.5, 3, 3.5, 4 and 5 or more standard
///         deviations off; that of mean + 4 sigma by 18, 26, 34, 43, 63 % and more. A single set's
///         limit scatters besides, as that of other 50 units would
/// @param factor  of robust_tolerance_factor() for as many units
/// @return why there is none otherwise: too few, with the number it takes, half of them alike, or
///         a limit that is no finite number
/// @throws std::invalid_argument if a value is not finite
/// Source  Hampel, J. Am. Stat. Assoc. 69(346), 383-393 (1974), for MAD and what it withstands
std::variant<RobustLimit, std::string> robust_limit(const std::vector<double>& values,
                                                    LimitSide side, double factor);

/// Why no limit can be learnt from so many units: "12 units, and a limit takes 20"; empty if it can
std::string too_few_units(std::size_t units);

}  // namespace rvbench::analysis
