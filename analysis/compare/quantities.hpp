#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "analysis/kinematics.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Something that is compared in each channel of each point.
struct Quantity {
  std::string name;            ///< "rms", "input shaft x2", "sun-planet mesh - input shaft"
  double order = not_known;    ///< of a line; NaN: a level of the whole signal
  double stray = 0;            ///< relative: how far the line may lie off its order
  std::string component = {};  ///< the part whose line it is
  std::vector<std::size_t> families = {};  ///< indices into Kinematics::signatures: it is in each

  bool is_line() const { return order > 0; }
  bool is_in(std::size_t family) const {
    return std::ranges::find(families, family) != families.end();
  }
};

/// Levels of the signal, in this order, before all lines.
enum class LevelIndex : std::size_t { rms, peak, crest_factor, kurtosis };

/// What is compared for a machine, whatever was measured: rms, peak, crest factor and kurtosis; of
/// each characteristic order the first three harmonics; of each mesh the sidebands at every order
/// that is locked to a shaft; the lines of each signature. Lines by rising order; of the same order
/// the first of these names stays, and characteristic orders share it.
/// Shape   four levels and any number of lines. Units  orders of the input shaft
/// Errors  none thrown. Source  ours; sidebands of a mesh: of meaning_of()
std::vector<Quantity> quantities_to_compare(const Kinematics& kinematics);

}  // namespace rvbench::analysis
