#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/proof/seal/draw.hpp"

namespace seal {

/// What the bench of an RV reducer is made of, SI.
struct BenchNumbers {
  double motor_inertia, sun_inertia, carrier_inertia, brake_inertia;
  std::array<double, 2> planet_inertia;
  double pull_out_torque_Nm, pull_out_slip, motor_ripple;
  double coupling_stiffness, coupling_damping;
  double sun_friction_Nm, creep_rad_s, sun_drag, brake_drag;
  double sun_radius_m, planet_radius_m, sun_teeth;
  struct Mesh {
    double place_rad, stiffness, damping, ripple, ripple_phase_rad, error_m, error_phase_rad;
  };
  std::array<Mesh, 2> mesh;
  double pins, pin_circle_m;
  struct Stage {
    double stiffness, damping;
  };
  std::array<Stage, 2> stage;
  double output_stiffness, output_damping;

  double ratio() const { return 1 + planet_radius_m / sun_radius_m * pins; }
};

/// The numbers that a plant file states for the RV-20E's bench.
/// @throws nlohmann::json::exception if it is another plant
BenchNumbers numbers_of(const nlohmann::json& plant);

/// Machines of which one number each lies a standard deviation of its tolerance beside the drawing.
std::vector<nlohmann::json> each_off(const nlohmann::json& plant);

/// A machine as it was built: each number that has a tolerance lies evenly within it.
nlohmann::json as_built(nlohmann::json plant, Draw& draw);

}  // namespace seal
