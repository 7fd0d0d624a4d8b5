#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <deque>

namespace rvbench::sim {

/// Brings x ← x + f(x) to rest in fewer rounds than the plain iteration, also where that one runs
/// away: the next step is the best mixture of the last ones, as if f were straight.
/// Source  Anderson, J. ACM 12(4), 547-560 (1965); Walker & Ni, SIAM J. Numer. Anal. 49(4),
///         1715-1735 (2011)
class AndersonMixing {
 public:
  explicit AndersonMixing(std::size_t depth) : depth_(depth) {}

  /// @param step  f at the present x, of one size at all calls
  /// @return what to add to x; the next call's step is taken to be there
  Eigen::VectorXd mixed(const Eigen::VectorXd& step);

 private:
  std::size_t depth_;
  Eigen::VectorXd last_step_, last_move_;
  std::deque<Eigen::VectorXd> changes_, moves_;  ///< of the step, and what they came of
};

}  // namespace rvbench::sim
