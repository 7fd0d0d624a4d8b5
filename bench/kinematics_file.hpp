#pragma once

#include <string>
#include <variant>
#include <vector>

#include "analysis/kinematics.hpp"
#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// A machine from a kinematics file: an RV reducer or a planetary stage by its tooth counts, or
/// shafts with their meshes and bearings.
/// @param name_or_path  a shipped one ("rv20e", "cwru_6205", ...), or a path
/// @return the machine, or every fault of the file
std::variant<analysis::Kinematics, std::vector<hal::ConfigFault>> read_kinematics(
    const std::string& name_or_path);

/// A machine, and what of it cannot be built as it is stated: rolling elements or planets that have
/// no room beside each other. Its orders are known all the same.
struct DoubtedMachine {
  analysis::Kinematics kinematics;
  std::vector<hal::ConfigFault> doubts;
};

/// As read_kinematics(), with doubts.
std::variant<DoubtedMachine, std::vector<hal::ConfigFault>> read_machine(
    const std::string& name_or_path);

/// The text of the same; empty if it cannot be read.
std::string kinematics_text(const std::string& name_or_path);

}  // namespace rvbench::bench
