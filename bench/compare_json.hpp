#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/compare/comparison.hpp"
#include "analysis/kinematics.hpp"

namespace rvbench::bench {

/// What stands around a comparison in compare.json and compare.html.
struct CompareFacts {
  std::string a, b;  ///< as they were given
  analysis::Kinematics kinematics;
  std::string software;
  std::vector<std::pair<std::string, std::string>> hashes;  ///< file, SHA-256
};

/// The document compare.json. Of lines that neither A nor B shows it lists only places where the
/// noise changed. Values that are not known are null; levels are in the unit of their channel.
std::string comparison_to_json(const analysis::Comparison& comparison, const CompareFacts& facts);

}  // namespace rvbench::bench
