#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "hal/clock.hpp"
#include "hal/recording_file.hpp"
#include "hal/replay_rig.hpp"
#include "hal/rig.hpp"

namespace rvbench::hal {

/// What the devices of a replay rig share: the recording, and which of its points is being played
/// from where.
///
/// Playing a point starts ReplayOptions::lead_in_s before its first sample, with its last ones,
/// and goes round as long as the command stays; the angle goes on without a jump.
class ReplayWorld final : public Backstage {
 public:
  /// `reader` holds acceleration, torque and angle.
  ReplayWorld(std::unique_ptr<RecordingReader> reader, const ReplayOptions& options,
              const Clock& clock);

  void command_speed(double speed_rpm);
  void command_brake(double torque_Nm);

  const RecordingLayout& layout() const { return reader_->layout(); }
  const ReplayOptions& options() const { return options_; }
  const Clock& clock() const { return clock_; }
  double fastest_rpm() const;

  /// Of the point that is played; 0 at standstill, NaN where the recording does not say.
  double measured_speed_rpm();
  double brake_torque_Nm();

  /// The scans and samples due since the last call. An error if the file cannot be read any more.
  Result<AccelerationBlock> take_accelerations();
  Result<TorqueBlock> take_torque();

 private:
  /// A point of the recording that can be played.
  struct Playable {
    int number;
    double speed_rpm;
    double load_pct;
  };
  /// A row of samples on a clock of its own that never stops.
  struct Track {
    double rate_Hz = 0;
    long sent = 0;
    long offset = 0;  ///< index in the recording = number on the clock + offset, going round
  };

  long due(const Track& track) const;
  std::optional<IoError> follow_command();
  std::size_t nearest() const;
  void start_playing(std::size_t chosen, Recording recording);
  TorqueSample sample(long number);

  std::mutex mutex_;  ///< in real time, drive and streams are asked by different threads
  std::unique_ptr<RecordingReader> reader_;
  ReplayOptions options_;
  const Clock& clock_;
  std::vector<Playable> playable_;
  std::size_t next_ = 0;  ///< the point that the same plan would play next
  double speed_rpm_ = 0;
  double brake_Nm_ = 0;
  double commanded_s_ = 0;  ///< when one of them last changed
  double played_from_s_ = 0;
  double followed_speed_rpm_ = 0;
  double followed_brake_Nm_ = 0;
  std::optional<std::size_t> playing_;
  Recording recording_;  ///< the point that is played
  Track accelerations_;
  Track torque_;
  double turn_rad_ = 0;   ///< the angle that one round of the recording adds
  double angle_rad_ = 0;  ///< as last sent
  double base_rad_ = 0;   ///< added to the recorded angle
};

}  // namespace rvbench::hal
