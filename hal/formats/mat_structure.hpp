#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// One variable of a MAT file that is a structure: its fields that are real arrays or text.
struct MatStructure {
  std::string name;  ///< of the variable
  std::map<std::string, Eigen::MatrixXd> numbers;
  std::map<std::string, std::string> texts;
};

/// A recording as the variables of a MAT file: a structure per channel, named after it, with the
/// fields data (a column), name, unit, rate_Hz and what else is known (facts.hpp); and `recording`,
/// with what is known of all.
std::vector<MatStructure> mat_structures(const Recording& recording);

/// The channel that a structure holds so; nothing if it is none.
std::optional<Channel> channel_in(const MatStructure& structure);

/// Whether it is the structure that says what is known of all, and if so takes that over.
bool take_recording(const MatStructure& structure, Recording& recording);

}  // namespace rvbench::hal::formats
