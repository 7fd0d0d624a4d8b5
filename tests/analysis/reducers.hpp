#pragma once

#include <catch2/catch.hpp>
#include <string>

#include "analysis/rv_reducer.hpp"

namespace rvbench::test {

/// With a bearing in each planet: every kind of signature there is.
inline analysis::Kinematics rv20e() {
  return analysis::rv_reducer("RV-20E", {9, 27, 2, 39, 40}, {11, 5, 26, 0});
}

/// i = 21: sun at 20/21 with 12 teeth, crank and planet at 10/21, crank in the housing 9/21, pins
/// and lobes at 90/21. Likewise with bearings.
inline analysis::Kinematics small_reducer() {
  return analysis::rv_reducer("small", {12, 24, 2, 9, 10}, {11, 5, 26, 0});
}

/// The first signature of a component.
inline std::size_t index_of(const analysis::Kinematics& kinematics, const std::string& component) {
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    if (kinematics.signatures[s].component == component) return s;
  }
  FAIL("no signature of " << component);
  return 0;
}

}  // namespace rvbench::test
