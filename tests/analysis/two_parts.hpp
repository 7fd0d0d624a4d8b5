#pragma once

#include <cmath>
#include <string>

#include "analysis/diagnosis.hpp"

namespace rvbench::test {

/// A machine of a shaft and a gear, whose limits are 0.2.
inline analysis::Kinematics two_parts() {
  analysis::Kinematics k;
  for (const char* component : {"shaft", "gear"}) {
    analysis::Signature s;
    s.component = component;
    s.mechanism = "wear";
    s.order = component == std::string("shaft") ? 2 : 2.5;
    s.harmonics = 2;
    s.depth_limit = 0.2;
    s.advice = "look at the " + s.component;
    k.signatures.push_back(s);
  }
  return k;
}

struct Shown {
  double depth, p_value;
};

inline constexpr Shown nothing{0.01, 0.5};

/// A record of two_parts() that shows so much of each.
inline analysis::Examination point(const std::string& source, Shown shaft, Shown gear) {
  analysis::Examination e;
  e.source = source;
  e.speed_rpm = 600;
  e.resolvable = true;
  e.periods = 8;
  int i = 0;
  for (const Shown& shown : {shaft, gear}) {
    analysis::SignatureScore score;
    score.signature = i;
    score.order = two_parts().signatures[static_cast<std::size_t>(i)].order;
    score.depth = shown.depth;
    score.p_value = shown.p_value;
    score.imf = 1;
    score.line_orders = {score.order, 2 * score.order};
    score.line_depths = {0.6 * shown.depth, 0.8 * shown.depth};
    score.channel_amplitudes = {shown.depth};
    score.log_likelihood_ratio = -std::log(shown.p_value);
    e.scores.push_back(score);
    ++i;
  }
  return e;
}

}  // namespace rvbench::test
