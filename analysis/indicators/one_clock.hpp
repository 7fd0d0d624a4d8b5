#pragma once

#include "hal/types/recording.hpp"

namespace rvbench::analysis {

/// Whether two channels were sampled at the same times: rate, start and number of samples.
/// Errors  none thrown; no channel has no clock
inline bool have_one_clock(const Channel* a, const Channel* b) {
  return a != nullptr && b != nullptr && a->rate_Hz == b->rate_Hz && a->start_s == b->start_s &&
         a->samples.size() == b->samples.size();
}

}  // namespace rvbench::analysis
