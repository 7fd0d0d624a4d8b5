#include "sim/common_motion.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sim {
namespace {

using hal::ConfigFault;
using units::two_pi;

constexpr double held_together = 1e-9;  // of the stiffest way: below it bodies move freely
constexpr double whole = 1e-6;          // of a turn
constexpr double rounding = 1e-6;

}  // namespace

std::variant<Eigen::VectorXd, ConfigFault> common_motion(const PlantModel& model) {
  const Eigen::Index n = model.inertia.size();
  const algebra::RightSingular ways = algebra::right_singular(linear_parts(model).stiffness);
  const Eigen::VectorXd& held = ways.values;
  const Eigen::Index free = (held.array() <= held_together * held[0]).count();
  if (free != 1) {
    return ConfigFault{0, "/bodies",
                       fmt::format("{} bodies that can turn by themselves, not 1", free)};
  }
  Eigen::VectorXd common = ways.vectors.col(n - 1);
  const double turning = held_together * common.cwiseAbs().maxCoeff();
  double slowest = std::numeric_limits<double>::infinity();
  for (double& turns : common) {
    if (std::abs(turns) <= turning) turns = 0;
    if (turns != 0 && std::abs(turns) < std::abs(slowest)) slowest = turns;
  }
  common /= slowest;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(common[i] - std::round(common[i])) > whole * std::abs(common[i])) {
      return ConfigFault{
          0, fmt::format("/bodies/{}", i),
          fmt::format("makes {:.9g} turns for each of the slowest body's: no period", common[i])};
    }
    common[i] = std::round(common[i]);
  }
  return common;
}

const PhysicsTerm* held_by(const PlantModel& model, const Eigen::VectorXd& turns) {
  PlantState here{Eigen::VectorXd::LinSpaced(turns.size(), 0.1, 0.2), turns,
                  Eigen::VectorXd::Zero(model.memory_size),
                  Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.pushed.size())), 0};
  PlantState there = here;
  there.q += two_pi * turns;
  for (const auto& term : model.terms) {
    Eigen::VectorXd before = Eigen::VectorXd::Zero(turns.size()), after = before;
    term->add_force(here, before);
    term->add_force(there, after);
    if ((after - before).norm() > rounding * before.norm()) return term.get();
  }
  return nullptr;
}

}  // namespace rvbench::sim
