#pragma once

#include <string>

#include "hal/types/result.hpp"

/// What every driver of a torque transducer says of it, in the same words.
namespace rvbench::hal::torque_transducer {

inline constexpr const char* zeroing = "zeroing";
inline constexpr const char* shunt_on = "shunt calibration is on";

inline IoError transducer_failure(IoErrc code, const std::string& what) {
  return {code, "torque transducer: " + what};
}

}  // namespace rvbench::hal::torque_transducer
