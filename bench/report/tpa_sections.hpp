#pragma once

#include <string>

#include "bench/tpa_study.hpp"

/// Sections of tpa.html. Each is HTML; empty if it has nothing to show.
namespace rvbench::bench::report {

/// Per target and band the paths' contributions as bars with their intervals, in the order of the
/// paths, and who leads in a table.
std::string contributions_part(const MotionAnswer& motion, const std::string& unit);

/// Contribution of each path over frequency, one map per target.
std::string frequency_maps(const MotionAnswer& motion, const std::string& unit);

/// As well over time.
std::string time_maps(const MotionAnswer& motion, const std::string& unit);

/// Measured against synthesised spectra at targets and at sensors that were not fitted to.
std::string validation_part(const MotionAnswer& motion, const std::string& unit);

/// Forces of the leading paths, condition number and kept singular values, line by line; of
/// references, how far they can be told apart.
std::string forces_part(const MotionAnswer& motion, const TpaFrfs& frfs);

/// Spectra of the targets before and after the repair.
std::string repair_part(const MotionAnswer& motion, const TpaStudy& study);

}  // namespace rvbench::bench::report
