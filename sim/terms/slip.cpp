#include "sim/terms/slip.hpp"

#include <algorithm>

#include "sim/effect_edits.hpp"

namespace rvbench::sim {
namespace {

constexpr double no_slip = 1e-6;

// Passes torque across the air gap by how far the rotor stays behind the field.
class AirGap final : public OneAxisTerm {
 public:
  AirGap(std::string_view name, const TermSite& at, double rated_slip)
      : OneAxisTerm(name, at.axis),
        field_rad_s_(at["speed"]),
        damping_(at["rated_torque"] / (std::max(rated_slip, no_slip) * field_rad_s_)) {}

  double effort(const PlantState& s) const override { return damping_ * (speed(s) - field_rad_s_); }
  double dissipated_power_W(const PlantState& s) const override {
    const double behind_rad_s = speed(s) - field_rad_s_;
    return damping_ * behind_rad_s * behind_rad_s;
  }
  double supplied_power_W(const PlantState& s) const override { return -effort(s) * field_rad_s_; }
  bool is_affine() const override { return true; }
  void add_linear(Eigen::MatrixXd&, Eigen::MatrixXd& damping) const override {
    add_between(damping, damping_);
  }
  void add_remainder(const PlantState&, Eigen::Ref<Eigen::VectorXd> f) const override {
    give(-damping_ * field_rad_s_, f);
  }

 private:
  double field_rad_s_, damping_;
};

ParameterCard field_speed() {
  return {.name = "speed",
          .unit = UnitKind::speed,
          .min = smallest,
          .max = unbounded,
          .start = 1,
          .fitted = false};
}

ParameterCard rated_torque() {
  return {.name = "rated_torque",
          .unit = UnitKind::force,
          .min = smallest,
          .max = unbounded,
          .start = 1,
          .fitted = false};
}

PlantSpec let_slip(PlantSpec plant, const EffectSite& site, const Parameters& parameters) {
  return replace_or_append(std::move(plant), "slip", site, parameters);
}

}  // namespace

TermType synchronous_drive() {
  return {.card = {.name = "synchronous_drive",
                   .effect = false,
                   .equation = "F = T_r/s_0·(v/ω_s − 1), s_0 = 1e-6",
                   .sign = "ω_s > 0 turns forward",
                   .leaves_out = "the swing of the load angle, pull-out",
                   .source = "Fitzgerald, Electric Machinery, ch. 5"},
          .parameters = {field_speed(), rated_torque()},
          .gate = {.translation = false, .between_two = false},
          .make = [](const TermSite& at) {
            return std::make_unique<AirGap>("synchronous_drive", at, no_slip);
          }};
}

TermType slip() {
  return {
      .card = {.name = "slip",
               .equation = "F = T_r/s_r·(v/ω_s − 1), so s = 1 − v/ω_s = s_r·T/T_r",
               .sign = "s_r >= 0: slower under a load that brakes",
               .leaves_out = "the bend towards pull-out, voltage, heating of the rotor",
               .source = "Fitzgerald, Electric Machinery, ch. 6: Kloss' curve near s = 0",
               .touches = {{Ledger::quasi_static, "speed, in proportion to load"},
                           {Ledger::electrical, "orders of the supply, which move with load"}},
               .must_not_touch = {{Ledger::shaft, "orders of shafts and teeth"},
                                  {Ledger::quasi_static, "speed without load"}},
               .experiment = "measure the supply's frequency: at synchronous speed nothing "
                             "else may lag behind it"},
      .parameters =
          {{.name = "rated_slip", .unit = UnitKind::ratio, .min = 0, .max = 0.2, .start = 0.03},
           field_speed(),
           rated_torque()},
      .gate = {.translation = false, .between_two = false, .in_place_of = "synchronous_drive"},
      .make =
          [](const TermSite& at) { return std::make_unique<AirGap>("slip", at, at["rated_slip"]); },
      .edit = let_slip};
}

}  // namespace rvbench::sim
