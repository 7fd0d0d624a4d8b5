#include "sim/terms/shear_thinning.hpp"

#include <cmath>

namespace rvbench::sim {
namespace {

constexpr double standstill = 1e-3;

class ShearThinning final : public OneAxisTerm {
 public:
  explicit ShearThinning(const TermSite& at)
      : OneAxisTerm("shear_thinning", at.axis),
        level_(at["level"]),
        at_speed_(at["at_speed"]),
        exponent_(at["exponent"]) {}

  double effort(const PlantState& s) const override {
    const double share = speed(s) / at_speed_;
    return level_ * share * std::pow(standstill * standstill + share * share, (exponent_ - 1) / 2);
  }
  double dissipated_power_W(const PlantState& s) const override { return effort(s) * speed(s); }
  double fastest_rad_s(const Eigen::VectorXd& inertia) const override {
    return level_ / at_speed_ * std::pow(standstill, exponent_ - 1) * mobility(inertia);
  }

 private:
  double level_, at_speed_, exponent_;
};

}  // namespace

TermType shear_thinning() {
  return {.card = {.name = "shear_thinning",
                   .equation = "F = T·sgn(v)·|v/v_0|^p",
                   .sign = "T >= 0 opposes motion",
                   .leaves_out = "temperature",
                   .source = "Bair, High Pressure Rheology for Quantitative "
                             "Elastohydrodynamics, ch. 6",
                   .touches = {{Ledger::quasi_static, "torque mean, concave in speed"}},
                   .must_not_touch = {{Ledger::quasi_static, "growth with load"},
                                      {Ledger::shaft, "lines of the shaft at constant speed"}},
                   .mimics = {"stribeck_friction", "viscous_friction", "thermal_viscosity"},
                   .experiment = "at least six speeds including creep"},
          .parameters =
              {{.name = "level", .unit = UnitKind::force, .min = 0, .max = unbounded, .start = 0.1},
               {.name = "at_speed",
                .unit = UnitKind::speed,
                .min = smallest,
                .max = unbounded,
                .start = 1,
                .fitted = false},
               {.name = "exponent",
                .unit = UnitKind::ratio,
                .min = 0.3,
                .max = 0.95,
                .start = 0.66,
                .fallback = 0.66,
                .fitted = false}},
          .make = [](const TermSite& at) { return std::make_unique<ShearThinning>(at); }};
}

}  // namespace rvbench::sim
