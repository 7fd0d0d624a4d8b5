#pragma once

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// Orders per line of a record's spectra, which hold whole periods of the gear train.
/// Units   orders of the input shaft
/// Errors  none thrown; infinite where the record holds no period
/// Source  one line per length of the record
inline double record_resolution(const Examination& record, const Kinematics& kinematics) {
  return 1 / (record.periods * kinematics.period_turns);
}

}  // namespace rvbench::analysis
