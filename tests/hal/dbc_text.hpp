#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"

namespace rvbench::test {

/// The simulated transducer's frame, as a supplier's sheet has it.
inline constexpr const char* torque_data = R"(
BO_ 385 TorqueData: 8 Transducer
 SG_ Torque : 0|32@1- (1e-06,0) [-2147.48|2147.48] "Nm" Bench
 SG_ Angle : 32|16@1+ (0.0054931640625,0) [0|360] "deg" Bench
 SG_ Counter : 48|8@1+ (1,0) [0|255] "" Bench
 SG_ State : 56|8@1+ (1,0) [0|255] "" Bench
)";

/// What is wrong, a line each: "7 /torque: ..."; empty if nothing is.
template <typename T>
std::string faults_in(const std::variant<T, std::vector<hal::ConfigFault>>& read) {
  std::string all;
  if (read.index() == 0) return all;
  for (const hal::ConfigFault& fault : std::get<1>(read)) {
    if (fault.line > 0) all += std::to_string(fault.line);
    all += fault.pointer + ": " + fault.message + "\n";
  }
  return all;
}

}  // namespace rvbench::test
