#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "sim/plant_model.hpp"
#include "sim/plant_spec.hpp"
#include "sim/steady_motion.hpp"

namespace rvbench::sim {

/// Where a force can act: on a body, against the housing; or in a joint, between the bodies of a
/// term that holds them together, as an error of its teeth does.
struct PushSite {
  std::string name;  ///< of the body or term
  std::string on;    ///< body that the force is told of: itself, the term's first
  bool is_joint = false;
};

/// Every body, then every term with a linear stiffness between two of them.
std::vector<PushSite> push_sites(const PlantSpec& plant, const PlantModel& model);

/// What small forces do to the outputs of a plant that turns steadily.
struct PushResponse {
  std::vector<PushSite> sites;
  /// Of each frequency: outputs x sites, complex amplitude in the output's unit per N or N·m.
  std::vector<Eigen::MatrixXcd> lines;
  Eigen::MatrixXd means;             ///< outputs x bodies: of constant forces
  Eigen::RowVectorXd slowest_rad_s;  ///< of constant forces: what the slowest body's speed gains
};

/// The bodies answer by (K + jωC − ω²M)⁻¹ about their mean motion; to a constant force, by another
/// speed and other deflections at which all forces balance again: K·x + C·r·ΔΩ = f, r·x = 0, with r
/// the turns of their common motion. A force in a joint acts on its bodies as its stiffness does,
/// and a transducer in series with the joint is passed it. The sensors are taken as linear there.
///
/// Leaves out: what periodic stiffness makes of a line at other orders; the delay of sensors
///
/// @param motion  of the plant, solved
/// @param frequencies_Hz  > 0
/// @return nothing if a constant force finds no balance
std::optional<PushResponse> push_response(const PlantSpec& plant, const PlantModel& model,
                                          const SteadyMotion& motion,
                                          const std::vector<double>& frequencies_Hz);

}  // namespace rvbench::sim
