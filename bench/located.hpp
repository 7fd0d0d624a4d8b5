#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/explain/explanation.hpp"
#include "analysis/explain/residual_cells.hpp"
#include "analysis/explain/selection.hpp"
#include "bench/missing_force.hpp"
#include "bench/twin.hpp"

namespace rvbench::bench {

/// Where recordings differ from the plant by more than chance, as it was and with what was left
/// out.
struct Located {
  std::size_t cells = 0;       ///< means and lines looked at; 0: the comparison has none
  std::size_t conditions = 0;  ///< that they were looked at under
  std::vector<analysis::ResidualCluster> before, after;
  MissingForce missing_before = {}, missing_after = {};
  std::vector<Twin::Noise> noise = {};  ///< what errors are made of
  /// Conditions of one speed and all loads, or of one load and all speeds: three or more.
  std::vector<std::vector<std::string>> rows = {};
};

/// @param found  with a base that was fitted, or nothing is located
Located locate(const Twin& twin, const analysis::Selection& found);

/// Where nothing was named but something stays clearly off under half of the conditions or more, no
/// chance did that: NULL becomes NONE_OF_THE_ABOVE. Of a line that the plant does not show at all,
/// one speed under all loads will do, or one load at all speeds.
void weigh_what_stays(const Located& located, analysis::Explanation& explanation);

/// "input_torque: mean, from record to record 0.0021 N·m"
std::string noise_text(const Twin::Noise& noise);

/// "input_torque order 8.926", "input_torque mean", "input_torque 100 Hz",
/// "motor_force at 1.2 to 1.9 s"
std::string place_text(const analysis::ResidualCluster& cluster);

}  // namespace rvbench::bench
