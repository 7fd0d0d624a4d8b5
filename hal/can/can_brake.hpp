#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hal/brake.hpp"
#include "hal/can/can_frames.hpp"
#include "hal/can_transport.hpp"
#include "hal/clock.hpp"

namespace rvbench::hal {

struct CanBrakeOptions {
  BrakeLimits limits{.max_torque_Nm = 600};
  double deadline_s = 0.2;  ///< how old the newest status may be
  double poll_s = 0.005;    ///< step of the clock while waiting for a status
};

/// Load brake over CAN frames: commands 0x201, statuses 0x281.
///
/// Errors   timeout: no status came; stale: its counter stood still; bad_reply: a frame of wrong
///          length or content; refused (connect only): the brake stays engaged or tripped
/// Loss     release() opens a link that was lost. read() goes on with it; set_torque() does not
///          before connect()
/// Time     connect() waits on the clock for the first status, until the deadline; the others never
class CanBrake final : public Brake {
 public:
  /// @param transport  receives the brake's frames only
  /// @param clock      must outlive the brake
  /// @throws std::invalid_argument naming the option that is out of range
  CanBrake(std::unique_ptr<CanTransport> transport, const CanBrakeOptions& options, Clock& clock);

  BrakeLimits limits() const override { return options_.limits; }
  Status connect() override;
  Status set_torque(double torque_Nm) override;
  Result<BrakeStatus> read() override;
  Status release() noexcept override;

 private:
  Status open_and_release();
  Status send(double torque_Nm, bool enable);
  Status take(const CanFrame& frame);
  Status await_status();

  std::unique_ptr<CanTransport> transport_;
  CanBrakeOptions options_;
  Clock& clock_;
  bool was_opened_ = false;
  bool connected_ = false;
  std::optional<IoError> lost_;  ///< how the link was, since connect(): no torque follows
  std::uint8_t command_counter_ = 0;
  bool has_status_ = false;  ///< one came since connect()
  bool saw_repeats_ = false;
  can_frames::BrakeStatusFrame status_;
  double fresh_s_ = 0;  ///< when the newest status came
};

}  // namespace rvbench::hal
