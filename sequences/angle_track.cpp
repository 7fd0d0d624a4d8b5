#include "sequences/angle_track.hpp"

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sequences {
namespace {

constexpr double kept_s = 0.3;

}  // namespace

void AngleTrack::add(double time_s, double angle_rad) {
  points_.push_back({time_s, angle_rad});
  while (points_.front().time_s < time_s - kept_s) points_.pop_front();
}

double AngleTrack::speed_rpm(double window_s) const {
  if (points_.empty()) return not_known;
  const Point& last = points_.back();
  for (auto point = points_.rbegin(); point != points_.rend(); ++point) {
    const double length_s = last.time_s - point->time_s;
    if (length_s >= window_s - 1e-6) {
      return units::rpm_from_rad_s((last.angle_rad - point->angle_rad) / length_s);
    }
  }
  return not_known;
}

}  // namespace rvbench::sequences
