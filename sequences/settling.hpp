#pragma once

#include <deque>

namespace rvbench::sequences {

/// When a point of the matrix counts as steady.
struct SettlingRule {
  double speed_tolerance_pct = 6;  ///< mean from the planned speed: an asynchronous motor slips
  double load_tolerance_pct = 10;  ///< the brake's own reading from the planned load, of rated
  double speed_band_pct = 1;       ///< each half second from the mean
  double torque_band_pct = 10;     ///< likewise, of the input torque
  double torque_band_Nm = 0.1;     ///< added to it: at no load there is next to no mean
  double hold_s = 2;               ///< for so long
  double timeout_s = 30;
};

/// Watches speed and torque in windows of half a second, and tells when all windows of the last
/// `hold_s` lie within the bands.
///
/// Speed is that of the measured angle over a window: it owes nothing to the drive's own estimate.
class Settling {
 public:
  Settling(const SettlingRule& rule, double planned_speed_rpm);

  /// The newest angle with its time, and the mean torque of the samples that came with it. A time
  /// that does not go on is no news: a tick without a fresh value counts for nothing.
  void add(double time_s, double angle_rad, double torque_Nm);

  bool settled() const;
  double mean_speed_rpm() const;  ///< of the windows held; NaN if there are none
  double mean_torque_Nm() const;

 private:
  struct Window {
    double speed_rpm, torque_Nm;
  };

  SettlingRule rule_;
  double planned_speed_rpm_;
  std::size_t held_;  ///< windows in hold_s
  std::deque<Window> windows_;
  bool started_ = false;
  double from_s_ = 0;
  double from_rad_ = 0;
  double newest_s_ = 0;
  double torque_sum_Nm_ = 0;
  int torques_ = 0;
};

}  // namespace rvbench::sequences
