#include "analysis/evidence/lines_by_depth.hpp"

#include <algorithm>
#include <numeric>

namespace rvbench::analysis {

std::vector<std::size_t> lines_by_depth(const SignatureScore& score) {
  std::vector<std::size_t> lines(score.line_depths.size());
  std::iota(lines.begin(), lines.end(), std::size_t{0});
  std::stable_sort(lines.begin(), lines.end(), [&](std::size_t a, std::size_t b) {
    return score.line_depths[a] > score.line_depths[b];
  });
  return lines;
}

}  // namespace rvbench::analysis
