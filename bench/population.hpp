#pragma once

#include <string>
#include <vector>

#include "bench/earlier_units.hpp"
#include "bench/unit_numbers.hpp"

namespace rvbench::bench {

/// Fewer units say nothing of what is usual.
inline constexpr std::size_t least_population = 8;

/// Where a unit's number lies among those of earlier units.
struct Standing {
  UnitNumber number;
  std::vector<double> passed, failed;  ///< of earlier units, by their verdict
  double median = 0;                   ///< of both together
  std::size_t better = 0;              ///< earlier units that are farther on the good side

  std::size_t units() const { return passed.size() + failed.size(); }
};

struct Population {
  std::size_t passed = 0, failed = 0;  ///< units
  std::vector<Standing> standings;     ///< the few worst; none below least_population

  std::size_t units() const { return passed + failed; }
};

/// A unit against the earlier ones: of its numbers the three that are nearest to their limit or
/// farthest beyond, and of those without a limit the ones that are farthest out on the bad side, in
/// deviations by the median absolute deviation; four in all.
///
/// Shape   each unit's values in the order of `numbers`
/// Errors  throws std::invalid_argument if a unit has another count of values
/// Source  median and MAD: Huber & Ronchetti, Robust Statistics (2nd ed., 2009); the choice is ours
Population population_of(const std::vector<UnitNumber>& numbers,
                         const std::vector<EarlierUnit>& earlier);

}  // namespace rvbench::bench
