#pragma once

#include <Eigen/Core>
#include <memory>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "sim/term_library.hpp"

namespace rvbench::sim {

/// One SI signal of the plant from a column of an Excitation: gain·column + offset + ramp·t.
struct SignalTap {
  int column = 0;
  double gain = 1;
  double offset = 0;
  double ramp_per_s = 0;
};

/// A plant ready to be integrated: names became indices, types became terms.
struct PlantModel {
  Eigen::VectorXd inertia;         ///< kg or kg·m² of each body
  Eigen::VectorXd start_position;  ///< of each body
  Eigen::VectorXd start_speed;
  std::vector<std::unique_ptr<PhysicsTerm>> terms;  ///< in order of the spec
  std::vector<int> pushed;       ///< by each of PlantState::u: the body, or -1 of a signal
  std::vector<int> prescribed;   ///< bodies whose motion is given
  std::vector<SignalTap> taps;   ///< of u, then position, speed, acceleration of each prescribed
  Eigen::Index memory_size = 0;  ///< of PlantState::z
};

/// How many columns an input takes in an Excitation: itself, and of a motion its derivatives or
/// integral.
int columns_of(InputKind kind);

/// @return the model, or the first thing that stands in its way (see check_plant())
std::variant<PlantModel, hal::ConfigFault> make_model(
    const PlantSpec& plant, const TermLibrary& library = standard_terms());

/// K and C of all terms' linear parts, n x n.
struct LinearParts {
  Eigen::MatrixXd stiffness, damping;
};
LinearParts linear_parts(const PlantModel& model);

/// PlantState::u of a plant under constant inputs.
/// @param inputs  of the channels of plant.inputs, in their order; none of them a motion
Eigen::VectorXd si_inputs(const PlantModel& model, const Eigen::VectorXd& inputs);

/// Steps per sample that resolve what the plant's nonlinear terms see: a 24th of its fastest
/// period or less, where a hardening spring's swing keeps time to 5e-6.
/// @return >= 1; 1 if every body's motion is prescribed, or the plant is linear
double substeps_wanted(const PlantModel& model, double rate_Hz);

}  // namespace rvbench::sim
