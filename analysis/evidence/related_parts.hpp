#pragma once

#include <cstddef>
#include <vector>

#include "analysis/diagnosis.hpp"

namespace rvbench::analysis {

/// A hypothesis that shows.
struct ShownPart {
  std::size_t signature = 0;  ///< index into Kinematics::signatures
  Finding finding;
  double weight = 0;  ///< severity over its limit, less what its growth speaks against it

  bool is_bad() const { return finding.severity > finding.limit; }
};

ShownPart shown_part(std::size_t signature, Finding finding);

/// No point counts as one that shows it.
void clear_shown(Finding& finding);

/// Puts the gravest part first, and a cause before its consequence. Joins parts of the same lines
/// into one finding. Marks a part that may follow from a graver one.
///
/// @param not_shown  takes those that may be another part's lines
/// Source  ours
void relate_parts(std::vector<ShownPart>& shown, std::vector<Finding>& not_shown,
                  const Kinematics& kinematics);

}  // namespace rvbench::analysis
