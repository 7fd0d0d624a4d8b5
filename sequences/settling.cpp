#include "sequences/settling.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

namespace rvbench::sequences {
namespace {

constexpr double window_s = 0.5;

}  // namespace

Settling::Settling(const SettlingRule& rule, double planned_speed_rpm)
    : rule_(rule),
      planned_speed_rpm_(planned_speed_rpm),
      held_(std::size_t(std::max(1.0, std::ceil(rule.hold_s / window_s - 1e-9)))) {}

void Settling::add(double time_s, double angle_rad, double torque_Nm) {
  if (!std::isfinite(angle_rad) || !std::isfinite(torque_Nm)) return;
  if (!started_) {
    started_ = true;
    from_s_ = newest_s_ = time_s;
    from_rad_ = angle_rad;
    return;
  }
  if (time_s <= newest_s_) return;
  newest_s_ = time_s;
  torque_sum_Nm_ += torque_Nm;
  ++torques_;
  const double length_s = time_s - from_s_;
  if (length_s < window_s - 1e-9) return;
  windows_.push_back({units::rpm_from_rad_s((angle_rad - from_rad_) / length_s),
                      torque_sum_Nm_ / double(torques_)});
  if (windows_.size() > held_) windows_.pop_front();
  from_s_ = time_s;
  from_rad_ = angle_rad;
  torque_sum_Nm_ = 0;
  torques_ = 0;
}

bool Settling::settled() const {
  if (windows_.size() < held_) return false;
  const double speed_rpm = mean_speed_rpm();
  const double torque_Nm = mean_torque_Nm();
  const double speed_band_rpm = std::abs(speed_rpm) * rule_.speed_band_pct / 100;
  const double torque_band_Nm =
      std::abs(torque_Nm) * rule_.torque_band_pct / 100 + rule_.torque_band_Nm;
  return std::abs(speed_rpm - planned_speed_rpm_) <=
             std::abs(planned_speed_rpm_) * rule_.speed_tolerance_pct / 100 &&
         std::ranges::all_of(windows_, [&](const Window& window) {
           return std::abs(window.speed_rpm - speed_rpm) <= speed_band_rpm &&
                  std::abs(window.torque_Nm - torque_Nm) <= torque_band_Nm;
         });
}

double Settling::mean_speed_rpm() const {
  double sum = 0;
  for (const Window& window : windows_) sum += window.speed_rpm;
  return windows_.empty() ? not_known : sum / double(windows_.size());
}

double Settling::mean_torque_Nm() const {
  double sum = 0;
  for (const Window& window : windows_) sum += window.torque_Nm;
  return windows_.empty() ? not_known : sum / double(windows_.size());
}

}  // namespace rvbench::sequences
