#pragma once

#include <vector>

#include "sim/term_library.hpp"

namespace rvbench::sim {

/// `wanted`, or wanted_2, wanted_3 ...: the first that no body and no term has.
std::string free_name(const PlantSpec& plant, const std::string& wanted);

/// Puts a term of this type in the place of the term site.reference, which leaves it its name,
/// bodies and the parameters that both have; without a reference it is one more term.
/// @throws std::invalid_argument if there is no such term, or the parameters are not complete
PlantSpec replace_or_append(PlantSpec plant, const std::string& type, const EffectSite& site,
                            const Parameters& parameters);

/// Names of the terms that hold a body on the housing. What acts on one body only, as weight and
/// unbalance do, pushes nothing back: it is none of them.
std::vector<std::string> holding(const PlantSpec& plant, std::string_view body,
                                 const TermLibrary& library);

struct BodySplit {
  std::string effect;  ///< names the new body and its terms
  double share = 0;    ///< of the inertia that goes to the far side, within (0, 1)
  double stiffness = 0;
  double damping = 0;
};

/// Moves a share of site.body_a's inertia, and the terms site.beyond, to a new body behind a spring
/// and a damper.
/// @throws std::invalid_argument if there is no such body or term, or the share is out of range
PlantSpec split_body(PlantSpec plant, const EffectSite& site, const BodySplit& split);

struct Resonance {
  std::string effect;  ///< names the spring and the damper
  double frequency_Hz = 0;
  double damping_ratio = 0;
};

/// Adds a body that a spring and a damper hold on another one, or on the housing, tuned to ring
/// there alone as the resonance says: k = (2πf)²·M, c = 2ζ·2πf·M.
void hang(PlantSpec& plant, const BodySpec& body, std::string_view on, const Resonance& resonance);

/// Of a fit's start, as a part of speed over way: three times what the body rings at.
inline constexpr double within_reach = 0.5;

/// f of a resonance that hangs on a body.
/// @param start  in speed over way
ParameterCard resonance_card(double start);
/// ζ of it.
ParameterCard damping_ratio_card(double start, double min = 0);

/// The output of that channel.
/// @throws std::invalid_argument if there is none
OutputSpec& output_of(PlantSpec& plant, const std::string& effect, const std::string& channel);

/// The plant with other sensors: on one body, in SI, without gain, offset or delay.
PlantSpec with_probes(PlantSpec plant, const std::string& body,
                      const std::vector<OutputKind>& kinds);

}  // namespace rvbench::sim
