#pragma once

#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// One number about one record, that a limit can be set on.
struct Indicator {
  std::string measure;       ///< a name of measure_names
  std::string of;            ///< band, order, mesh and gear, or channel; empty: of the whole signal
  double value = 0;          ///< finite
  std::string unit;          ///< "1", "m/s²", "arcsec"; empty: not known
  double error = not_known;  ///< half of its 95 % interval; NaN: not known
};

}  // namespace rvbench::analysis
