#include "sim/rv_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/units.hpp"
#include "sim/draw.hpp"

namespace rvbench::sim {
namespace {

using units::two_pi;

constexpr double support_stiffness_N_m = 0.75e6;  // 3·E·I/L³ of a 10 mm shaft, 74 mm cantilevered
constexpr double support_preload_N = 31;          // assumed: a bearing that is never unloaded
constexpr double axial_share = 0.3;               // of the bending, by a tilted raceway: assumed
constexpr double pin_stiffness_N_m = 1e7;         // of a proud pin in its groove: assumed
constexpr double reference_speed_rad_s = 126.7;   // 1210 rpm: contact noise is stated there

// Contact noise per N of contact force at the reference speed. Assumed: of such a size that sound
// units come to nearly 0.1 g on the housing, as the article's do.
constexpr double bearing_noise_gain = 6.4e-3;
constexpr double mesh_noise_gain = 1.0e-3;
constexpr double pin_noise_gain = 1.0e-4;
constexpr double crank_noise_gain = 3.0e-5;

// How much rougher a contact is, or how much more it bears, per µm of deviation: assumed.
constexpr double edge_roughness_per_um = 0.2;  // a misaligned shaft carries on its bearing's edges
constexpr double flank_roughness_per_um = 0.15;
constexpr double tooth_roughness_per_um = 0.05;
constexpr double pin_roughness_per_um = 0.5;
constexpr double wander_per_um = 0.05;  // of the discs' load, by unequal cranks
constexpr double blow_N_per_N_um = 4e-4;

constexpr int sun_roughness_harmonics = 8;  // as 1/√h: one tooth of nine, rounded by the contact
// A bad flank is felt somewhat longer than its tooth is in mesh; a disc's load zone leans on a pin
// over half a radian: assumed.
constexpr double bad_flank_width_teeth = 1.3;
constexpr double bad_pin_width_rad = 0.5;
constexpr double heard_swing = 0.3;  // a mesh near the port's side over one far from it: assumed
constexpr double pressure_angle_rad = 0.35;  // 20°

// Which way a thing at `angle_rad` points, in X (up) and Z (left).
Eigen::Vector2d direction(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }

}  // namespace

RvContacts::RvContacts(const RvUnit& unit, const RvTrain& train, double rate_Hz)
    : unit_(unit),
      step_s_(1 / rate_Hz),
      spall_({.slip = unit.bearing_slip,
              .blow_N_per_N = blow_N_per_N_um * unit.deviations.bearing_spall_um},
             unit.noise_seed + 1),
      forces_N_(Eigen::VectorXd::Zero(ports::count)) {
  const RvDeviations& d = unit.deviations;
  bad_flank_.add_bump(unit.phases_rad[phase_of::planet_bad_tooth],
                      bad_flank_width_teeth * two_pi / train.meshes().front()->planet_teeth(),
                      flank_roughness_per_um * d.planet_bad_tooth_um);
  bad_pin_.add_bump(unit.phases_rad[phase_of::bad_pin], bad_pin_width_rad, d.bad_pin_um);
  for (int h = 1; h <= sun_roughness_harmonics; ++h) {
    sun_roughness_.add_cosine(h, tooth_roughness_per_um * d.sun_tooth_error_um / std::sqrt(h),
                              h * (h + 1) * unit.phases_rad[phase_of::sun_tooth_error]);
  }
  Draw seeds(unit.noise_seed);
  const auto noise = [&](double gain) {
    return ContactNoise(gain * unit.noise_level_factor, unit.noise_colour, seeds.seed());
  };
  for (int i = 0; i < 3; ++i) bearing_noise_.push_back(noise(bearing_noise_gain));
  const std::size_t planets = train.meshes().size();
  for (std::size_t k = 0; k < planets; ++k) mesh_noise_.push_back(noise(mesh_noise_gain));
  for (int disc = 0; disc < 2; ++disc) pin_noise_.push_back(noise(pin_noise_gain));
  for (std::size_t k = 0; k < planets; ++k) crank_noise_.push_back(noise(crank_noise_gain));
}

const Eigen::VectorXd& RvContacts::forces_N(const RvTrain& train) {
  const double speed_ratio = train.input_speed_rad_s() / reference_speed_rad_s;
  forces_N_.setZero();
  const Eigen::Vector2d sun_load_N = add_sun_meshes(train, speed_ratio);
  add_input_bearing(train.shaft_angle_rad(), speed_ratio, sun_load_N);
  add_pin_shell(train, speed_ratio);
  add_crank_bearings(train, speed_ratio);
  return forces_N_;
}

// The support of the cantilevered shaft carries its preload, the run-out that turns with the
// shaft, the bending that an angular misalignment forces on it twice per turn, and what the
// planets' pushes on the sun leave over.
void RvContacts::add_input_bearing(double shaft_rad, double speed_ratio,
                                   const Eigen::Vector2d& sun_load_N) {
  const RvDeviations& d = unit_.deviations;
  const double runout_N = support_stiffness_N_m * d.shaft_eccentricity_um * um;
  const double bending_N = support_stiffness_N_m * d.shaft_misalignment_um * um;
  const double twice = std::cos(2 * shaft_rad + unit_.phases_rad[phase_of::shaft_misalignment]);
  const Eigen::Vector2d load_N =
      Eigen::Vector2d(support_preload_N + bending_N * twice, 0) +
      runout_N * direction(shaft_rad + unit_.phases_rad[phase_of::shaft_eccentricity]) + sun_load_N;
  const double pressed_N = load_N.norm() * (1 + edge_roughness_per_um * d.shaft_misalignment_um);
  forces_N_.segment<2>(ports::input_bearing) += load_N - sun_load_N;  // that has its own port
  forces_N_[ports::input_bearing + 2] +=
      axial_share * bending_N *
      std::cos(shaft_rad + unit_.phases_rad[phase_of::shaft_misalignment]);
  for (int i = 0; i < 3; ++i) {
    forces_N_[ports::input_bearing + i] +=
        bearing_noise_[static_cast<std::size_t>(i)].force_N(pressed_N, speed_ratio);
  }
}

// Each planet pushes the sun sideways along its line of action; the nearer a planet is to the
// port's side of the housing, the better it is heard. Returns what the pushes leave over.
Eigen::Vector2d RvContacts::add_sun_meshes(const RvTrain& train, double speed_ratio) {
  const PlantState& s = train.state();
  Eigen::Vector2d left_over_N = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < train.meshes().size(); ++k) {
    const double place_rad = train.place_rad(k);
    const PlanetMesh& mesh = *train.meshes()[k];
    const double force_N = mesh.force_N(s);
    double roughness = 1 + sun_roughness_(mesh.seen_angle_rad(s));
    if (static_cast<int>(k) == unit_.marked_planet) {
      roughness += bad_flank_(train.crank_angle_rad(k));
    }
    const double heard = 1 + heard_swing * std::cos(place_rad);
    const double noise_N =
        heard * mesh_noise_[k].force_N(force_N * std::max(roughness, 0.0), speed_ratio);
    const Eigen::Vector2d line_of_action = direction(place_rad + two_pi / 4 - pressure_angle_rad);
    forces_N_.segment<2>(ports::sun_mesh) += (force_N + noise_N) * line_of_action;
    left_over_N += force_N * line_of_action;
  }
  return left_over_N;
}

// The two discs lean on the shell on opposite sides; a proud pin takes more than its share each
// time a disc's load zone passes it.
void RvContacts::add_pin_shell(const RvTrain& train, double speed_ratio) {
  const PlantState& s = train.state();
  const double radius_m = train.stages().front()->params().pin_circle_radius_m;
  double torque_Nm = 0;
  for (const CycloidStage* stage : train.stages()) torque_Nm += stage->torque_Nm(s);
  const double orbit_rad = train.stages()[0]->orbit_angle_rad(s);
  const double crank_rad = train.crank_angle_rad(0);
  for (int disc = 0; disc < 2; ++disc) {
    const double share = 0.5 * (1 + (disc == 0 ? 1 : -1) * unit_.disc_mismatch);
    const double zone_rad = orbit_rad + disc * two_pi / 2;
    const double wander =
        1 + wander_per_um * unit_.deviations.crank_error_um *
                (std::cos(orbit_rad + unit_.phases_rad[phase_of::crank_error]) +
                 std::cos(crank_rad + 2 * unit_.phases_rad[phase_of::crank_error]));
    const double load_N = share * torque_Nm / radius_m * wander;
    const double proud_um = bad_pin_(zone_rad);
    const double noise_N = pin_noise_[static_cast<std::size_t>(disc)].force_N(
        load_N * (1 + pin_roughness_per_um * proud_um), speed_ratio);
    forces_N_.segment<2>(ports::pin_shell) += (load_N + noise_N) * direction(zone_rad);
    forces_N_.segment<2>(ports::pin_shell) +=
        share * pin_stiffness_N_m * proud_um * um * direction(unit_.phases_rad[phase_of::bad_pin]);
  }
}

void RvContacts::add_crank_bearings(const RvTrain& train, double speed_ratio) {
  const PlantState& s = train.state();
  for (std::size_t k = 0; k < train.stages().size(); ++k) {
    const double place_rad = train.place_rad(k);
    const CycloidStage& stage = *train.stages()[k];
    const double load_N = stage.torque_Nm(s) / stage.params().pin_circle_radius_m;
    double force_N = crank_noise_[k].force_N(load_N, speed_ratio);
    if (static_cast<int>(k) == unit_.marked_planet) {
      force_N += spall_.force_N(train.crank_angle_rad(k), load_N, step_s_);
    }
    forces_N_.segment<2>(ports::crank_bearing) += force_N * direction(place_rad);
  }
}

}  // namespace rvbench::sim
