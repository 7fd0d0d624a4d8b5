#include "sim/terms/cycloid_stage.hpp"

#include <cmath>
#include <stdexcept>

namespace rvbench::sim {

CycloidStage::CycloidStage(Params p) : p_(std::move(p)) {
  if (!(p_.pins >= 1) || p_.pins != std::floor(p_.pins)) {
    throw std::invalid_argument("cycloid_stage: pins must be a whole number >= 1");
  }
  if (!(p_.pin_circle_radius_m > 0)) {
    throw std::invalid_argument("cycloid_stage: pin_circle_radius must be > 0");
  }
  if (!(p_.stiffness_Nm_rad > 0 && p_.damping_Nms_rad >= 0)) {
    throw std::invalid_argument("cycloid_stage: stiffness must be > 0 and damping >= 0");
  }
}

double CycloidStage::orbit_angle_rad(const PlantState& s) const {
  return s.q[p_.crank] - s.q[p_.carrier];
}

double CycloidStage::deflection_rad(const PlantState& s) const {
  return s.q[p_.crank] / p_.pins - s.q[p_.carrier] + p_.error_rad(orbit_angle_rad(s));
}

double CycloidStage::rate_rad_s(const PlantState& s) const {
  return s.v[p_.crank] / p_.pins - s.v[p_.carrier];
}

double CycloidStage::torque_Nm(const PlantState& s) const {
  return p_.stiffness_Nm_rad * deflection_rad(s) + p_.damping_Nms_rad * rate_rad_s(s);
}

void CycloidStage::apply(double torque_Nm, Eigen::Ref<Eigen::VectorXd> f) const {
  f[p_.crank] -= torque_Nm / p_.pins;
  f[p_.carrier] += torque_Nm;
}

void CycloidStage::add_force(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  apply(torque_Nm(s), f);
}

void CycloidStage::add_remainder(const PlantState& s, Eigen::Ref<Eigen::VectorXd> f) const {
  apply(p_.stiffness_Nm_rad * p_.error_rad(orbit_angle_rad(s)), f);
}

double CycloidStage::stored_energy_J(const PlantState& s) const {
  const double d = deflection_rad(s);
  return 0.5 * p_.stiffness_Nm_rad * d * d;
}

double CycloidStage::dissipated_power_W(const PlantState& s) const {
  const double rate = rate_rad_s(s);
  return p_.damping_Nms_rad * rate * rate;
}

void CycloidStage::add_orders(const Eigen::VectorXd& turns, std::set<int>& orders) const {
  for (const int harmonic : p_.error_rad.harmonics()) {
    add_order(harmonic * (turns[p_.crank] - turns[p_.carrier]), orders);
  }
}

void CycloidStage::add_linear(Eigen::MatrixXd& stiffness, Eigen::MatrixXd& damping) const {
  Eigen::VectorXd arm = Eigen::VectorXd::Zero(stiffness.rows());
  arm[p_.crank] = 1.0 / p_.pins;
  arm[p_.carrier] = -1;
  stiffness += p_.stiffness_Nm_rad * arm * arm.transpose();
  damping += p_.damping_Nms_rad * arm * arm.transpose();
}

TermType cycloid_stage() {
  const auto deviation = [](std::string name, UnitKind unit, double min) {
    return ParameterCard{.name = std::move(name),
                         .unit = unit,
                         .min = min,
                         .max = unbounded,
                         .start = 0,
                         .fallback = 0};
  };
  return {.card = {.name = "cycloid_stage",
                   .effect = false,
                   .equation =
                       "T = k·(ψ/z_p − θ_c + e(φ)/R) + c·(dψ/dt/z_p − ω_c), φ = ψ − θ_c; on the "
                       "crank F = T/z_p, on the carrier −T",
                   .sign = "a turning crank drives the carrier forward",
                   .leaves_out = "clearance, load sharing among pins, hysteresis, the slope de/dφ",
                   .source = "Blanche & Yang, J. Mech. Des. 111(3), 337-344 (1989)"},
          .parameters = {{.name = "pins",
                          .unit = UnitKind::ratio,
                          .min = 1,
                          .max = 1e4,
                          .start = 40,
                          .fitted = false},
                         {.name = "pin_circle_radius",
                          .unit = UnitKind::length,
                          .min = smallest,
                          .max = unbounded,
                          .start = 0.05,
                          .fitted = false},
                         {.name = "stiffness",
                          .unit = UnitKind::stiffness,
                          .min = smallest,
                          .max = unbounded,
                          .start = 1},
                         {.name = "damping",
                          .unit = UnitKind::damping,
                          .min = 0,
                          .max = unbounded,
                          .start = 0.05},
                         deviation("crank_error", UnitKind::length, 0),
                         deviation("crank_phase", UnitKind::angle, -unbounded),
                         deviation("pin_error", UnitKind::length, 0),
                         deviation("pin_phase", UnitKind::angle, -unbounded)},
          .gate = {.translation = false, .on_one = false},
          .make = [](const TermSite& at) {
            CycloidStage::Params stage{.crank = at.axis.body_a,
                                       .carrier = at.axis.body_b,
                                       .pins = at["pins"],
                                       .pin_circle_radius_m = at["pin_circle_radius"],
                                       .stiffness_Nm_rad = at["stiffness"],
                                       .damping_Nms_rad = at["damping"],
                                       .error_rad = {}};
            const double radius_m = stage.pin_circle_radius_m;
            stage.error_rad.add_cosine(1, at["crank_error"] / radius_m, at["crank_phase"]);
            stage.error_rad.add_cosine(static_cast<int>(stage.pins), at["pin_error"] / radius_m,
                                       at["pin_phase"]);
            return std::make_unique<CycloidStage>(std::move(stage));
          }};
}

}  // namespace rvbench::sim
