#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

namespace rvbench::sim {

/// The orders of a period at which a plant's bodies may move while they turn steadily, and how few
/// samples of that period tell them apart.
///
/// Orders   what most terms have in common is a lattice: all its multiples are there. The orders of
///          terms that would make it much finer stand beside it: they are there themselves, and
///          their sums and differences with the lattice and with each other
/// Samples  fewer than twice the highest order, where most orders are known to be empty
/// Leaves out: what two of those others and one more of anything bring together
class PeriodOrders {
 public:
  /// @param pushes   orders of each term's own push, all > 0; see PhysicsTerm::add_orders
  /// @param highest  order that is asked for, >= 1
  PeriodOrders(const std::vector<std::set<int>>& pushes, int highest);

  const std::vector<int>& orders() const { return orders_; }  ///< ascending, 1 .. highest
  int highest() const { return highest_; }                    ///< that was asked for
  Eigen::Index samples() const { return samples_; }           ///< evenly over the period

 private:
  std::vector<int> orders_;
  int highest_;
  Eigen::Index samples_;
};

}  // namespace rvbench::sim
