#pragma once

#include <string>

#include "hal/types/units.hpp"
#include "sim/term_library.hpp"
#include "sim/terms/one_axis_term.hpp"

namespace rvbench::sim {

/// Pushes body_a forward as F = −(A·cos 2πft + B·sin 2πft), whatever the plant does.
class PeriodicPush final : public OneAxisTerm {
 public:
  PeriodicPush(std::string_view name, Axis axis, double cosine, double sine, double frequency_Hz);

  double effort(const PlantState& s) const override;
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd&) const override { return frequency_rad_s_; }
  double rhythm_Hz(const PlantState&) const override { return frequency_rad_s_ / units::two_pi; }

 private:
  double cosine_, sine_, frequency_rad_s_;
};

/// A or B, as every type that pushes periodically asks for them.
ParameterCard push_card(std::string name);

}  // namespace rvbench::sim
