#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "tests/proof/seal/bench_effect.hpp"
#include "tests/proof/seal/bench_numbers.hpp"
#include "tests/proof/seal/turn_table.hpp"

namespace seal {

inline constexpr double turn = 2 * std::numbers::pi;

/// An effect that may be hidden in a bench: what the answer ought to be, and how to make it.
struct HiddenInBench {
  std::string name;
  std::vector<std::string> also = {};     ///< other names that these records cannot tell it from
  std::vector<std::string> bodies = {};   ///< of the joint that it acts in; empty: none, or all
  bool anywhere = false;                  ///< these records do not tell where
  std::vector<std::string> without = {};  ///< parameters that the nominal plant then lacks
  std::vector<std::string> needs = {};    ///< that the machine must not do without
  std::string parameter = {};             ///< of rvbench's term, that the size is comparable with
  double size = 1;                        ///< what a search for the right one starts with
  double most = std::numeric_limits<double>::infinity();
  /// Where its line is, by supply and shaft; nothing: its lines are orders.
  std::function<double(double supply_Hz, double shaft_Hz)> line_Hz = {};
  bool in_means = false;      ///< it has no lines
  bool in_own_lines = false;  ///< it changes lines that the machine has anyway, and has no others
  std::function<std::unique_ptr<BenchEffect>(double size)> make;
};

inline std::string planet_of(int stage) { return stage == 0 ? "planet_1" : "planet_2"; }

HiddenInBench brake_ripple(const BenchNumbers& n, Draw& draw);
HiddenInBench cage_slip(const BenchNumbers& n, Draw& draw);
HiddenInBench crank_eccentricity(const BenchNumbers& n, Draw& draw);
HiddenInBench external_force(const BenchNumbers& n, Draw& draw);
HiddenInBench five_arms(const BenchNumbers& n, Draw& draw);
HiddenInBench gear_eccentricity(const BenchNumbers& n, Draw& draw);
HiddenInBench inverter_ripple(const BenchNumbers& n, Draw& draw);
HiddenInBench load_friction(const BenchNumbers& n, Draw& draw);
HiddenInBench magnetic_poles(const BenchNumbers& n, Draw& draw);
HiddenInBench mains_hum(const BenchNumbers& n, Draw& draw);
HiddenInBench mesh_stiffness_variation(const BenchNumbers& n, Draw& draw);
HiddenInBench misalignment(const BenchNumbers& n, Draw& draw);
HiddenInBench oil_whirl(const BenchNumbers& n, Draw& draw);
HiddenInBench pin_ripple(const BenchNumbers& n, Draw& draw);
HiddenInBench rotor_bar(const BenchNumbers& n, Draw& draw);
HiddenInBench speed_modulation(const BenchNumbers& n, Draw& draw);
HiddenInBench tooth_damage(const BenchNumbers& n, Draw& draw);
HiddenInBench torsional_mode(const BenchNumbers& n, Draw& draw);
HiddenInBench transmission_error(const BenchNumbers& n, Draw& draw);

}  // namespace seal
