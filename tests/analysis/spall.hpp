#pragma once

#include <string>

#include "analysis/kinematics.hpp"

namespace rvbench::test {

/// A part of a bearing that is spalled: its harmonics without sidebands, off their orders together
/// by its slip.
inline analysis::Signature spall_of(const std::string& component, double order, int harmonics,
                                    double slip = 0.02) {
  analysis::Signature s;
  s.component = component;
  s.mechanism = "spall";
  s.order = order;
  s.harmonics = harmonics;
  s.slip = slip;
  return s;
}

}  // namespace rvbench::test
