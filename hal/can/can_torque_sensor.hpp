#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "hal/can/can_frames.hpp"
#include "hal/can/frame_clock.hpp"
#include "hal/can_transport.hpp"
#include "hal/clock.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::hal {

struct CanTorqueSensorOptions {
  double rate_Hz = 500;     ///< the transducer's own sample rate
  double deadline_s = 0.2;  ///< how old the newest sample may be
  /// What a frame says; nothing if it says nothing that can be used.
  std::function<std::optional<can_frames::TorqueFrame>(const CanFrame&)> decode =
      can_frames::torque_from_frame;
};

/// Torque transducer over CAN frames, one per sample: 0x181 of can_frames, or those of a DBC file.
///
/// Samples  lost frames are found by the rolling counter and filled with NaN; the angle is
///          unwrapped over gaps at the last known speed, which holds as long as the speed changes
///          by less than half a turn per gap. Their times are those of a FrameClock: frames come
///          late, each by another while
/// Wraps    of the 8-bit counter are told by the time of arrival: 256 frames are lost only if so
///          many periods have passed without one. A burst that was held up for 239 periods or less
///          is told from that; of one that was held up for longer, 256 samples count as lost, and
///          as many of what follows are dropped. Of a transducer that is slower than it says, by
///          up to 5 %, these periods are fewer
/// Errors   timeout: nothing came; stale: the counter stood still; bad_reply: a frame of wrong
///          length, or one that says zeroing, overload or shunt on. Samples of a failed read()
///          count as lost in the next one
/// Time     connect() waits on the clock for the first sample, until the deadline; read() never
class CanTorqueSensor final : public TorqueSensor {
 public:
  /// @param transport  receives the transducer's frames only
  /// @param clock      must outlive the sensor
  /// @throws std::invalid_argument if an option is not finite and positive
  CanTorqueSensor(std::unique_ptr<CanTransport> transport, const CanTorqueSensorOptions& options,
                  Clock& clock);

  double rate_Hz() const override { return options_.rate_Hz; }
  Status connect() override;
  Result<TorqueBlock> read() override;

 private:
  /// Where the stream of samples stands.
  struct Track {
    explicit Track(double rate_Hz) : clock(rate_Hz) {}

    bool started = false;
    FrameClock clock;
    can_frames::TorqueFrame newest;
    double due_s = 0;             ///< when the newest sample came, or should have
    double time_s = 0;            ///< and when it was taken
    double angle_turns = 0;       ///< unwrapped
    double turns_per_sample = 0;  ///< at the newest sample
  };

  Status take(const CanFrame& frame, Track& track, TorqueBlock& block);
  void append(const can_frames::TorqueFrame& frame, double time_s, Track& track,
              TorqueBlock& block);
  std::int64_t samples_since(const Track& track, const can_frames::TorqueFrame& frame,
                             double time_s) const;

  std::unique_ptr<CanTransport> transport_;
  CanTorqueSensorOptions options_;
  Clock& clock_;
  bool connected_ = false;
  bool saw_repeats_ = false;
  double fresh_s_ = 0;  ///< when the newest sample was taken
  Track track_;
};

}  // namespace rvbench::hal
