#pragma once

#include <optional>

#include "hal/recording_file.hpp"
#include "sequences/bench_devices.hpp"

namespace rvbench::sequences {

/// Hands the blocks of one point to the recording and measures the record as it grows.
///
/// Turns are counted on the measured angle where both sample clocks have samples, so that neither
/// stream of a finished record is short of them.
class PointRecorder {
 public:
  explicit PointRecorder(hal::RecordingWriter& recording) : recording_(recording) {}

  void open(int point);
  bool is_open() const { return is_open_; }
  Status take(const FreshValues& fresh);
  bool covers(double input_turns) const;

  /// The record takes no more samples; it has not ended, for a hole at its end may yet be told.
  void seal() { is_sealed_ = true; }
  /// Scans have come that are so much later than the record's last one.
  bool is_followed_for(double duration_s) const;

  /// Ends the point. A record in which samples are missing is never "ok", nor one in which one
  /// stream falls behind the other: a gap that nobody told. Nor one whose mean input torque, in
  /// the direction of rotation and over any stretch of a second and ten turns, is less than the
  /// load needs: a transducer with the wrong sign, or none.
  /// @param least_torque_Nm  at the input; NaN: not known
  Result<hal::PointResult> close(std::string status, double least_torque_Nm = not_known);

 private:
  /// A piece of the record whose mean torque is looked at by itself.
  struct Stretch {
    double from_s = not_known, from_rad = not_known;
    double torque_sum_Nm = 0;
    long samples = 0;
  };

  void take_sample(double time_s, const hal::TorqueSample& sample);
  void take_stretch(double time_s, const hal::TorqueSample& sample);
  void compare_streams(const FreshValues& fresh);
  double weakest_driving_Nm(const hal::PointResult& whole) const;

  struct SoFar {
    double t0_s = not_known;  ///< of the first acceleration
    double accelerations_end_s = not_known;
    double first_s = not_known, first_rad = not_known;
    double last_s = not_known, last_rad = not_known;
    double torque_sum_Nm = 0;
    long torque_known = 0;  ///< samples in the sum
    long torque_samples = 0;
    long torque_lost = 0;
    long scans_lost = 0;
    double acceleration_time_uncertainty_s = not_known, torque_time_uncertainty_s = not_known;
    Stretch stretch;
    double weakest_Nm = not_known;  ///< mean of a stretch, in the direction of rotation
    double least_lag_s = not_known, most_lag_s = not_known;  ///< of accelerations behind torque
    double longest_block_s = 0;
  };

  hal::RecordingWriter& recording_;
  bool is_open_ = false;
  bool is_sealed_ = false;
  double followed_until_s_ = not_known;
  int point_ = 0;
  SoFar so_far_;
};

}  // namespace rvbench::sequences
