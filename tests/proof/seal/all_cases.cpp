#include "tests/proof/seal/sealed_case.hpp"

namespace seal {
namespace {

using Names = std::vector<std::string>;

// What hides in one machine by itself, how far below the strongest line (of a slide: below what it
// takes to move it), how far above the noise in its bin, under the middle one of the conditions.
const std::vector<CasePlan> singles{
    {0, "single", "bench", "", {"pin_ripple"}, 20, 10},
    {0, "single", "bench", "", {"pin_ripple"}, 30, 3},
    {0, "single", "bench", "", {"pin_ripple"}, 30, 20},
    {0, "single", "bench", "", {"pin_ripple"}, 40, 10},
    {0, "single", "bench", "", {"crank_eccentricity"}, 20, 10},
    {0, "single", "bench", "", {"crank_eccentricity"}, 30, 3},
    {0, "single", "bench", "", {"crank_eccentricity"}, 40, 20},
    {0, "single", "bench", "", {"gear_eccentricity"}, 20, 20},
    {0, "single", "bench", "", {"gear_eccentricity"}, 30, 10},
    {0, "single", "bench", "", {"tooth_damage"}, 20, 10},
    {0, "single", "bench", "", {"tooth_damage"}, 30, 3},
    {0, "single", "bench", "", {"tooth_damage"}, 40, 20},
    {0, "single", "bench", "", {"transmission_error"}, 20, 10},
    {0, "single", "bench", "", {"transmission_error"}, 30, 20},
    {0, "single", "bench", "", {"mesh_stiffness_variation"}, 20, 10},
    {0, "single", "bench", "", {"mesh_stiffness_variation"}, 30, 20},
    {0, "single", "bench", "", {"misalignment"}, 20, 10},
    {0, "single", "bench", "", {"misalignment"}, 30, 3},
    {0, "single", "bench", "", {"misalignment"}, 30, -3},
    {0, "single", "bench", "", {"external_force"}, 20, 10},
    {0, "single", "bench", "", {"external_force"}, 30, 3},
    {0, "single", "bench", "", {"torsional_mode"}, 20, 10},
    {0, "single", "bench", "", {"torsional_mode"}, 30, 20},
    {0, "single", "bench", "", {"torsional_mode"}, 20, 20},
    {0, "single", "bench", "", {"rotor_bar"}, 20, 10},
    {0, "single", "bench", "", {"rotor_bar"}, 30, 3},
    {0, "single", "bench", "", {"brake_ripple"}, 20, 10},
    {0, "single", "bench", "", {"brake_ripple"}, 30, 20},
    {0, "single", "bench", "", {"speed_modulation"}, 20, 10},
    {0, "single", "bench", "", {"inverter_ripple"}, 20, 10},
    {0, "single", "bench", "", {"mains_hum"}, 20, 10},
    {0, "single", "bench", "", {"load_friction"}, 20, 20},
    {0, "single", "axis", "", {"coulomb_friction"}, 20, 10},
    {0, "single", "axis", "", {"coulomb_friction"}, 30, 3},
    {0, "single", "axis", "", {"asymmetric_friction"}, 20, 10},
    {0, "single", "axis", "", {"asymmetric_friction"}, 30, 3},
    {0, "single", "axis", "", {"stribeck_friction"}, 20, 10},
    {0, "single", "axis", "", {"viscous_friction"}, 20, 10},
    {0, "single", "axis", "", {"shear_thinning"}, 20, 20},
    {0, "single", "axis", "", {"nonlinear_damping"}, 20, 10},
    {0, "single", "axis", "", {"stiffness_hysteresis"}, 20, 20},
    {0, "single", "axis", "", {"cubic_stiffness"}, 20, 3},
    {0, "single", "oscillator", "", {"cubic_stiffness"}, 20, 10},
    {0, "single", "oscillator", "", {"cubic_stiffness"}, 30, 3},
    {0, "single", "oscillator", "", {"quadratic_stiffness"}, 20, 10},
    {0, "single", "oscillator", "", {"quadratic_stiffness"}, 30, -3},
    {0, "single", "oscillator", "", {"looseness"}, 20, 10},
    {0, "single", "oscillator", "", {"nonlinear_damping"}, 20, 10},
    {0, "single", "oscillator", "", {"stiffness_hysteresis"}, 20, 20},
    {0, "single", "oscillator", "", {"coulomb_friction"}, 20, -10}};

const std::vector<CasePlan> several{
    {0, "several", "bench", "", {"pin_ripple", "misalignment"}, 20, 10},
    {0, "several", "bench", "", {"crank_eccentricity", "external_force"}, 20, 10},
    {0, "several", "bench", "", {"tooth_damage", "misalignment"}, 20, 20},
    {0, "several", "bench", "", {"gear_eccentricity", "pin_ripple"}, 20, 20},
    {0, "several", "bench", "", {"brake_ripple", "crank_eccentricity"}, 20, 20},
    {0, "several", "bench", "", {"rotor_bar", "pin_ripple"}, 20, 20},
    {0, "several", "bench", "", {"torsional_mode", "pin_ripple"}, 20, 20},
    {0, "several", "bench", "", {"misalignment", "mains_hum"}, 20, 10},
    {0, "several", "bench", "", {"tooth_damage", "crank_eccentricity"}, 30, 20},
    {0, "several", "bench", "", {"inverter_ripple", "misalignment"}, 20, 10},
    {0, "several", "bench", "", {"gear_eccentricity", "external_force"}, 30, 20},
    {0, "several", "bench", "", {"pin_ripple", "crank_eccentricity"}, 30, 10},
    {0, "several", "bench", "", {"brake_ripple", "misalignment"}, 30, 10},
    {0, "several", "bench", "", {"mesh_stiffness_variation", "pin_ripple"}, 20, 20},
    {0, "several", "bench", "", {"pin_ripple", "misalignment", "external_force"}, 20, 20},
    {0, "several", "bench", "", {"crank_eccentricity", "brake_ripple", "misalignment"}, 20, 20},
    {0, "several", "bench", "", {"tooth_damage", "pin_ripple", "rotor_bar"}, 20, 20},
    {0, "several", "bench", "", {"gear_eccentricity", "misalignment", "mains_hum"}, 20, 20},
    {0, "several", "bench", "", {"pin_ripple", "crank_eccentricity", "external_force"}, 30, 20},
    {0, "several", "axis", "", {"coulomb_friction", "cubic_stiffness"}, 20, 20},
    {0, "several", "axis", "", {"coulomb_friction", "asymmetric_friction"}, 20, 20},
    {0, "several", "axis", "", {"viscous_friction", "coulomb_friction"}, 20, 10},
    {0, "several", "oscillator", "", {"cubic_stiffness", "nonlinear_damping"}, 20, 20},
    {0, "several", "oscillator", "", {"quadratic_stiffness", "cubic_stiffness"}, 20, 20},
    {0, "several", "oscillator", "", {"cubic_stiffness", "coulomb_friction"}, 20, 20}};

// What rvbench has no term for.
const std::vector<CasePlan> outside{{0, "outside", "bench", "", {"oil_whirl"}, 20, 20},
                                    {0, "outside", "bench", "", {"oil_whirl"}, 30, 10},
                                    {0, "outside", "bench", "", {"oil_whirl"}, 20, 10},
                                    {0, "outside", "bench", "", {"five_arms"}, 20, 20},
                                    {0, "outside", "bench", "", {"five_arms"}, 30, 10},
                                    {0, "outside", "bench", "", {"five_arms"}, 20, 10},
                                    {0, "outside", "bench", "", {"magnetic_poles"}, 20, 20},
                                    {0, "outside", "bench", "", {"magnetic_poles"}, 30, 20},
                                    {0, "outside", "bench", "", {"cage_slip"}, 20, 20},
                                    {0, "outside", "bench", "", {"cage_slip"}, 10, 20},
                                    {0, "outside", "axis", "", {"screw_ripple"}, 20, 20},
                                    {0, "outside", "axis", "", {"screw_ripple"}, 30, 20},
                                    {0, "outside", "axis", "", {"screw_ripple"}, 20, 10},
                                    {0, "outside", "oscillator", "", {"pumped_spring"}, 20, 20},
                                    {0, "outside", "oscillator", "", {"pumped_spring"}, 10, 20}};

// What these motions cannot tell from something else.
const std::vector<CasePlan> twins{{0, "twin", "bench", "", {"external_force"}, 20, 20},
                                  {0, "twin", "bench", "", {"speed_modulation"}, 20, 20},
                                  {0, "twin", "bench", "", {"mains_hum"}, 20, 20},
                                  {0, "twin", "axis", "one way", {"coulomb_friction"}, 20, 20},
                                  {0, "twin", "axis", "one way", {"asymmetric_friction"}, 20, 20},
                                  {0, "twin", "axis", "one way", {"coulomb_friction"}, 20, 10},
                                  {0, "twin", "axis", "one way", {"asymmetric_friction"}, 30, 20},
                                  {0, "twin", "axis", "one way", {"coulomb_friction"}, 30, 10},
                                  {0, "twin", "bench", "", {"mains_hum"}, 30, 10},
                                  {0, "twin", "bench", "", {"external_force"}, 30, 20}};

}  // namespace

std::vector<CasePlan> all_cases() {
  std::vector<CasePlan> all;
  for (const char* like : {"clean", "nuisance", "strong"}) {
    for (int i = 0; i < 20; ++i) {
      all.push_back({0, "null", i < 12 ? "bench" : i < 16 ? "axis" : "oscillator", "", {like}});
    }
  }
  for (const auto* more : {&singles, &several, &outside, &twins}) {
    all.insert(all.end(), more->begin(), more->end());
  }
  for (std::size_t i = 0; i < all.size(); ++i) all[i].number = static_cast<int>(i) + 1;
  return all;
}

}  // namespace seal
