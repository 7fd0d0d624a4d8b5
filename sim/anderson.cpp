#include "sim/anderson.hpp"

#include "hal/types/linear_algebra.hpp"

namespace rvbench::sim {

Eigen::VectorXd AndersonMixing::mixed(const Eigen::VectorXd& step) {
  if (last_step_.size() > 0) {
    changes_.push_back(step - last_step_);
    moves_.push_back(last_move_);
    if (changes_.size() > depth_) {
      changes_.pop_front();
      moves_.pop_front();
    }
  }
  Eigen::VectorXd move = step;
  if (!changes_.empty()) {
    const auto depth = static_cast<Eigen::Index>(changes_.size());
    Eigen::MatrixXd changes(step.size(), depth), moves(step.size(), depth);
    for (Eigen::Index i = 0; i < depth; ++i) {
      changes.col(i) = changes_[static_cast<std::size_t>(i)];
      moves.col(i) = moves_[static_cast<std::size_t>(i)];
    }
    move -= (moves + changes) * algebra::MinimumNorm(changes).solve(step);
  }
  last_step_ = step;
  last_move_ = move;
  return move;
}

}  // namespace rvbench::sim
