#pragma once

#include <string>

#include "analysis/kinematics.hpp"
#include "bench/judgement.hpp"

namespace rvbench::bench::report {

/// What the matrix shows of one record.
struct MatrixCell {
  std::string level;  ///< "low", "mid-level", "high"; "spoiled", "absent", "torsion": no depth
  std::string text;   ///< not escaped
};

/// The worst significant modulation depth of a record in units of its limit, or why it has none.
MatrixCell matrix_cell(const JudgedPoint& point, const analysis::Kinematics& kinematics);

}  // namespace rvbench::bench::report
