#include "analysis/indicators/torsion_turns.hpp"

#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr double whole_branch = 0.5;  // of the peak before

}  // namespace

std::vector<TorsionTurn> torsion_turns(const Eigen::Ref<const Eigen::VectorXd>& torque_Nm,
                                       const Eigen::Ref<const Eigen::VectorXd>& torsion_rad,
                                       double light_Nm) {
  std::vector<TorsionTurn> turns;
  int side = 0;
  for (Eigen::Index i = 0; i < torque_Nm.size(); ++i) {
    const int now = torque_Nm[i] > light_Nm ? 1 : torque_Nm[i] < -light_Nm ? -1 : side;
    if (now != side) turns.push_back({i, torque_Nm[i]});
    side = now;
    if (side == 0) continue;
    TorsionTurn& turn = turns.back();
    if (side * (torsion_rad[i] - torsion_rad[turn.at]) > 0) turn.at = i;
    if (side * (torque_Nm[i] - turn.peak_Nm) > 0) turn.peak_Nm = torque_Nm[i];
  }
  const std::size_t n = turns.size();
  const bool is_cut_short =
      n >= 2 && std::abs(turns[n - 1].peak_Nm) < whole_branch * std::abs(turns[n - 2].peak_Nm);
  if (is_cut_short) turns.pop_back();
  return turns;
}

}  // namespace rvbench::analysis
