#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/judgement.hpp"
#include "bench/unit_numbers.hpp"

namespace rvbench::bench {

/// What another unit came to in the numbers that one is asked about.
struct EarlierUnit {
  std::string serial;
  bool passed = false;
  std::vector<double> values;  ///< one for each number asked; NaN: not known
};

/// More are not read: a report must not take longer with every unit.
inline constexpr std::size_t most_earlier_units = 100;

/// The units that were tested before this run by the same plan on the same kind of machine, below
/// the same root as the run folder; of each its last run before this one that came to PASS or FAIL.
/// The latest first; none where the folder does not lie as a run's does: <root>/<serial>/<time>.
///
/// Units   of the numbers
/// Errors  none thrown: a run that cannot be read is no unit to compare with
/// Source  verdict.json of the run folders that results.db names; where it cannot be used, of all
std::vector<EarlierUnit> earlier_units(const std::filesystem::path& run, const Judgement& judgement,
                                       const std::vector<UnitNumber>& numbers);

}  // namespace rvbench::bench
