#include "sequences/device_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rvbench::sequences {

void DeviceWatch::note_failure(double now_s, const IoError& why) {
  error = describe(why);
  due_s = now_s + std::min(0.5, 0.01 * std::pow(2.0, ++failures));
}

std::string DeviceWatch::lost(double now_s, double stale_after_s) const {
  const double age_s = now_s - seen_s;
  if (age_s <= stale_after_s + 1e-6) return "";
  if (seen_s == never_seen_s) {
    return device + " has never answered" + (error.empty() ? "" : " (" + error + ")");
  }
  return fmt::format("{} silent for {:.2f} s{}", device, age_s,
                     error.empty() ? "" : " (" + error + ")");
}

}  // namespace rvbench::sequences
