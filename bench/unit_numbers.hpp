#pragma once

#include <string>
#include <vector>

#include "bench/judgement.hpp"

namespace rvbench::bench {

/// A number of a unit, by which units are compared: the worst of an indicator over all points and
/// channels, or at some points, or how deep a part modulates the vibration.
struct UnitNumber {
  std::string measure;
  std::string of;  ///< band, order or mesh; of a depth "input_shaft: misalignment"; empty: any
  std::string unit;
  bool worst_is_least = false;
  double value = not_known;
  double limit = not_known;  ///< in the same unit; NaN: there is none
  SetPoint at = {};          ///< the points it is of; any: all together
};

/// "band_rms of sun-planet mesh", "kurtosis at 1815 rpm, 100 % load"
std::string name_of(const UnitNumber& number);

/// How near it is to its limit: 1 is at it, more is beyond; NaN without a limit.
double share_of_limit(const UnitNumber& number);

/// The numbers of a unit that are known: of each limit of the plan, of each part that rose above
/// the noise, and the worst of each indicator that has no limit.
/// Units  of the limit, else as measured. Errors  none thrown. Source  worst_indicator()
std::vector<UnitNumber> numbers_of(const Judgement& judgement);

/// The same number of another unit, in the unit asked for; NaN if it is not known there. A depth is
/// 0 where the part did not rise above the noise and noise could not hide more than its limit.
double value_in(const Judgement& other, const UnitNumber& asked);

}  // namespace rvbench::bench
