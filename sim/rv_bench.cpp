#include "sim/rv_bench.hpp"

#include <cmath>

#include "hal/types/units.hpp"
#include "sim/draw.hpp"

namespace rvbench::sim {
namespace {

using units::two_pi;

constexpr int substeps = 4;  // plant steps per DAQ sample: resolves the 5 kHz planet mode
constexpr int planet_teeth = 27;
constexpr int sun_teeth = 9;
constexpr int pins = 40;
constexpr double gear_ratio = 121;
constexpr double sun_base_radius_m = 5.3e-3;
constexpr double planet_base_radius_m = 15.9e-3;
constexpr double pin_circle_radius_m = 52e-3;
constexpr double support_stiffness_N_m = 0.75e6;  // 3·E·I/L³ of a 10 mm shaft, 73 mm cantilevered
constexpr double support_preload_N = 31;
constexpr double reference_speed_rad_s = 126.7;  // 1210 rpm: contact noise is stated there

// Contact noise per N of contact force at the reference speed.
constexpr double bearing_noise_gain = 6.4e-3;
constexpr double mesh_noise_gain = 1.0e-3;
constexpr double pin_noise_gain = 1.0e-4;
constexpr double crank_noise_gain = 3.0e-5;
// A misaligned shaft carries on the edges of its bearing: rougher contact by this much per µm.
constexpr double edge_roughness_per_um = 0.2;
constexpr double sensor_noise_m_s2 = 0.01;
constexpr double settling_s = 1;  // 18 time constants of the slowest mode

constexpr double um = 1e-6;

enum Phase { shaft, misalignment, sun_error, profile, planet, bad_tooth, crank, spread, pin, race };

/// Which way a thing at `angle_rad` points, in X (up) and Z (left).
Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

}  // namespace

RvBench::RvBench(const RvUnit& unit)
    : unit_(unit),
      housing_(unit.modes, 2 * rate_Hz),
      decimator_(sensors),
      spall_({.slip = unit.bearing_slip, .blow_N_per_N = 4e-4 * unit.deviations.bearing_spall_um},
             unit.noise_seed + 1),
      forces_N_(Eigen::VectorXd::Zero(ports::count)),
      accelerations_(Eigen::VectorXd::Zero(2 * sensors)),
      sensor_engine_(unit.noise_seed + 2) {
  make_plant(unit);
  make_noise(unit);
  settle();
}

// Errors and preloads push from the first step on: what that stirs up dies out before the bench is
// handed over.
void RvBench::settle() {
  Eigen::VectorXf scan(sensors);
  const auto scans = static_cast<int>(settling_s * rate_Hz);
  for (int i = 0; i < scans; ++i) step(scan);
}

void RvBench::make_plant(const RvUnit& unit) {
  const RvDeviations& d = unit.deviations;
  const std::vector<double>& phase = unit.phases_rad;
  const int n = unit.planets;
  const int carrier = 2 + n;
  std::vector<std::unique_ptr<PhysicsTerm>> terms;
  const auto add = [&terms](auto term) {
    auto owned = std::make_unique<decltype(term)>(std::move(term));
    auto* raw = owned.get();
    terms.push_back(std::move(owned));
    return raw;
  };

  motor_ = add(InductionMotor({.body = 0,
                               .pull_out_torque_Nm = 12,
                               .pull_out_slip = 0.15 * unit.motor_slip_factor,
                               .ripple = 0.02}));
  coupling_ = add(
      ShaftTorsion({.body_a = 0, .body_b = 1, .stiffness_Nm_rad = 600, .damping_Nms_rad = 0.05}));
  add(Friction({.body = 1,
                .coulomb_Nm = 0.15 * unit.friction_factor,
                .viscous_Nms_rad = 5e-4 * unit.friction_factor,
                .creep_speed_rad_s = 2}));

  for (int k = 0; k < n; ++k) {
    const double place_rad = two_pi * k / n;
    PlanetMesh::Params mesh{.sun = 1,
                            .carrier = carrier,
                            .planet = 2 + k,
                            .place_rad = place_rad,
                            .sun_base_radius_m = sun_base_radius_m,
                            .planet_base_radius_m = planet_base_radius_m,
                            .stiffness_N_m = 8e7,
                            .damping_Ns_m = 1000,
                            .sun_error_m = {},
                            .planet_error_m = {},
                            .stiffness_ripple = {}};
    for (int h = 1; h <= 4; ++h) {
      mesh.sun_error_m.add_cosine(h * sun_teeth, d.mesh_profile_um * um / h, h * phase[profile]);
      mesh.stiffness_ripple.add_cosine(h * sun_teeth, 0.08 / h, h * phase[profile] + 1);
      mesh.sun_error_m.add_cosine(h, d.sun_tooth_error_um * um / h, h * h * phase[sun_error]);
    }
    mesh.planet_error_m.add_cosine(1, d.planet_eccentricity_um * um, phase[planet] + place_rad);
    if (k == unit.marked_planet) {
      mesh.planet_error_m.add_bump(phase[bad_tooth], two_pi / planet_teeth / 3,
                                   -d.planet_bad_tooth_um * um);
    }
    meshes_.push_back(add(PlanetMesh(std::move(mesh))));

    CycloidStage::Params stage{.crank = 2 + k,
                               .carrier = carrier,
                               .pins = pins,
                               .stiffness_Nm_rad = 168e3 / n,
                               .damping_Nms_rad = 80.0 / n,
                               .error_rad = {}};
    stage.error_rad.add_cosine(1, d.crank_error_um * um / pin_circle_radius_m,
                               phase[crank] + place_rad);
    stage.error_rad.add_cosine(pins, d.pin_spread_um * um / pin_circle_radius_m, phase[spread]);
    stages_.push_back(add(CycloidStage(std::move(stage))));
  }

  output_shaft_ = add(ShaftTorsion(
      {.body_a = carrier, .body_b = carrier + 1, .stiffness_Nm_rad = 6e4, .damping_Nms_rad = 20}));
  brake_ = add(Friction({.body = carrier + 1, .viscous_Nms_rad = 0.5, .creep_speed_rad_s = 0.05}));

  Eigen::VectorXd inertia(4 + n);
  inertia.setConstant(2e-5);  // cranks with their planets
  inertia[0] = 2e-3;
  inertia[1] = 5e-5;
  inertia[carrier] = 0.03;
  inertia[carrier + 1] = 0.3;
  plant_ = std::make_unique<Plant>(inertia, std::move(terms), 1 / (rate_Hz * substeps));
}

void RvBench::make_noise(const RvUnit& unit) {
  const RvDeviations& d = unit.deviations;
  bad_flank_.add_bump(unit.phases_rad[bad_tooth], 1.3 * two_pi / planet_teeth,
                      0.15 * d.planet_bad_tooth_um);
  bad_pin_.add_bump(unit.phases_rad[pin], 0.5, d.bad_pin_um);
  for (int h = 1; h <= 8; ++h) {
    sun_roughness_.add_cosine(h, 0.05 * d.sun_tooth_error_um / std::sqrt(h),
                              h * (h + 1) * unit.phases_rad[sun_error]);
  }
  Draw seeds(unit.noise_seed);
  const auto noise = [&](double gain) {
    return ContactNoise(gain * unit.noise_level_factor, unit.noise_colour, seeds.seed());
  };
  for (int i = 0; i < 3; ++i) bearing_noise_.push_back(noise(bearing_noise_gain));
  for (int k = 0; k < unit.planets; ++k) mesh_noise_.push_back(noise(mesh_noise_gain));
  for (int disc = 0; disc < 2; ++disc) pin_noise_.push_back(noise(pin_noise_gain));
  for (int k = 0; k < unit.planets; ++k) crank_noise_.push_back(noise(crank_noise_gain));
}

double RvBench::input_angle_rad() const {
  return plant_->state().q[1] + wrapped_turns_ * gear_ratio * two_pi;
}

double RvBench::output_speed_rad_s() const {
  return plant_->state().v[plant_->state().v.size() - 1];
}

double RvBench::brake_torque_Nm() const { return output_shaft_->torque_Nm(plant_->state()); }

void RvBench::wrap() {
  const Eigen::VectorXd& q = plant_->state().q;
  const Eigen::Index carrier = q.size() - 2;
  if (std::abs(q[carrier]) < two_pi) return;
  const double turns = std::trunc(q[carrier] / two_pi);
  Eigen::VectorXd whole = Eigen::VectorXd::Constant(q.size(), pins);
  whole[0] = whole[1] = gear_ratio;
  whole[carrier] = whole[carrier + 1] = 1;
  plant_->shift(-whole * turns * two_pi);
  wrapped_turns_ += turns;
}

void RvBench::step(Eigen::Ref<Eigen::VectorXf> accelerations_m_s2) {
  for (int half = 0; half < 2; ++half) {
    for (int i = 0; i < substeps / 2; ++i) {
      motor_->advance(plant_->step_s());
      plant_->step();
    }
    gather_forces();
    housing_.step(forces_N_, accelerations_.segment(half * sensors, sensors));
  }
  wrap();
  decimator_.step(accelerations_.head(sensors), accelerations_.tail(sensors), accelerations_m_s2);
  const auto noise = static_cast<float>(sensor_noise_m_s2 * unit_.noise_level_factor);
  for (Eigen::Index i = 0; i < sensors; ++i) {
    const auto gain = static_cast<float>(unit_.sensor_gains[static_cast<std::size_t>(i)]);
    accelerations_m_s2[i] = gain * accelerations_m_s2[i] + noise * sensor_noise_(sensor_engine_);
  }
}

void RvBench::gather_forces() {
  const PlantState& s = plant_->state();
  const double speed_ratio = s.v[1] / reference_speed_rad_s;
  const double carrier_rad = s.q[s.q.size() - 2];
  forces_N_.setZero();
  add_input_bearing(s.q[1], speed_ratio, add_sun_meshes(carrier_rad, speed_ratio));
  add_pin_shell(speed_ratio);
  add_crank_bearings(carrier_rad, speed_ratio);
}

// The support of the cantilevered shaft carries its preload, the run-out that turns with the
// shaft, the bending that an angular misalignment forces on it twice per turn, and what the
// planets' pushes on the sun leave over.
void RvBench::add_input_bearing(double shaft_rad, double speed_ratio,
                                const Eigen::Vector2d& sun_load_N) {
  const RvDeviations& d = unit_.deviations;
  const double runout_N = support_stiffness_N_m * d.shaft_eccentricity_um * um;
  const double bending_N = support_stiffness_N_m * d.shaft_misalignment_um * um;
  const double twice = std::cos(2 * shaft_rad + unit_.phases_rad[misalignment]);
  const Eigen::Vector2d load_N = Eigen::Vector2d(support_preload_N + bending_N * twice, 0) +
                                 runout_N * direction(shaft_rad + unit_.phases_rad[shaft]) +
                                 sun_load_N;
  const double pressed_N = load_N.norm() * (1 + edge_roughness_per_um * d.shaft_misalignment_um);
  forces_N_.segment<2>(ports::input_bearing) += load_N - sun_load_N;  // that has its own port
  forces_N_[ports::input_bearing + 2] +=
      0.3 * bending_N * std::cos(shaft_rad + unit_.phases_rad[misalignment]);
  for (int i = 0; i < 3; ++i) {
    forces_N_[ports::input_bearing + i] +=
        bearing_noise_[static_cast<std::size_t>(i)].force_N(pressed_N, speed_ratio);
  }
}

// Each planet pushes the sun sideways along its line of action; the nearer a planet is to the
// port's side of the housing, the better it is heard. Returns what the pushes leave over.
Eigen::Vector2d RvBench::add_sun_meshes(double carrier_rad, double speed_ratio) {
  const PlantState& s = plant_->state();
  Eigen::Vector2d left_over_N = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < meshes_.size(); ++k) {
    const double place_rad =
        carrier_rad + two_pi * static_cast<double>(k) / static_cast<double>(meshes_.size());
    const double force_N = meshes_[k]->force_N(s);
    double roughness = 1 + sun_roughness_(meshes_[k]->seen_angle_rad(s));
    if (static_cast<int>(k) == unit_.marked_planet) {
      roughness += bad_flank_(s.q[2 + static_cast<Eigen::Index>(k)]);
    }
    const double heard = 1 + 0.3 * std::cos(place_rad);
    const double noise_N =
        heard * mesh_noise_[k].force_N(force_N * std::max(roughness, 0.0), speed_ratio);
    const Eigen::Vector2d line_of_action = direction(place_rad + two_pi / 4 - 0.35);
    forces_N_.segment<2>(ports::sun_mesh) += (force_N + noise_N) * line_of_action;
    left_over_N += force_N * line_of_action;
  }
  return left_over_N;
}

// The two discs lean on the shell on opposite sides; a proud pin takes more than its share each
// time a disc's load zone passes it.
void RvBench::add_pin_shell(double speed_ratio) {
  const PlantState& s = plant_->state();
  double torque_Nm = 0;
  for (const CycloidStage* stage : stages_) torque_Nm += stage->torque_Nm(s);
  const double orbit_rad = stages_[0]->orbit_angle_rad(s);
  const double crank_rad = s.q[2];
  for (int disc = 0; disc < 2; ++disc) {
    const double share = 0.5 * (1 + (disc == 0 ? 1 : -1) * unit_.disc_mismatch);
    const double zone_rad = orbit_rad + disc * two_pi / 2;
    const double wander = 1 + 0.05 * unit_.deviations.crank_error_um *
                                  (std::cos(orbit_rad + unit_.phases_rad[crank]) +
                                   std::cos(crank_rad + 2 * unit_.phases_rad[crank]));
    const double load_N = share * torque_Nm / pin_circle_radius_m * wander;
    const double proud_um = bad_pin_(zone_rad);
    const double noise_N = pin_noise_[static_cast<std::size_t>(disc)].force_N(
        load_N * (1 + 0.5 * proud_um), speed_ratio);
    forces_N_.segment<2>(ports::pin_shell) += (load_N + noise_N) * direction(zone_rad);
    forces_N_.segment<2>(ports::pin_shell) +=
        share * 1e7 * proud_um * um * direction(unit_.phases_rad[pin]);
  }
}

void RvBench::add_crank_bearings(double carrier_rad, double speed_ratio) {
  const PlantState& s = plant_->state();
  for (std::size_t k = 0; k < stages_.size(); ++k) {
    const double place_rad =
        carrier_rad + two_pi * static_cast<double>(k) / static_cast<double>(stages_.size());
    const double load_N = stages_[k]->torque_Nm(s) / pin_circle_radius_m;
    double force_N = crank_noise_[k].force_N(load_N, speed_ratio);
    if (static_cast<int>(k) == unit_.marked_planet) {
      force_N += spall_.force_N(s.q[2 + static_cast<Eigen::Index>(k)], load_N, 1 / (2 * rate_Hz));
    }
    forces_N_.segment<2>(ports::crank_bearing) += force_N * direction(place_rad);
  }
}

}  // namespace rvbench::sim
