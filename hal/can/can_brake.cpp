#include "hal/can/can_brake.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "hal/can/waiting_frames.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

IoError failure(IoErrc code, const std::string& what) { return {code, "brake: " + what}; }

}  // namespace

CanBrake::CanBrake(std::unique_ptr<CanTransport> transport, const CanBrakeOptions& options,
                   Clock& clock)
    : transport_(std::move(transport)), options_(options), clock_(clock) {
  if (!transport_) throw std::invalid_argument("CanBrake: transport is null");
  require_positive(options.limits.max_torque_Nm, "CanBrake", "max_torque_Nm");
  require_positive(options.limits.residual_torque_pct, "CanBrake", "residual_torque_pct");
  require_positive(options.deadline_s, "CanBrake", "deadline_s");
  require_positive(options.poll_s, "CanBrake", "poll_s");
  if (options.limits.max_torque_Nm > can_frames::max_brake_torque_Nm) {
    throw std::invalid_argument(fmt::format("CanBrake: max_torque_Nm is {}, at most {}",
                                            options.limits.max_torque_Nm,
                                            can_frames::max_brake_torque_Nm));
  }
}

Status CanBrake::connect() {
  connected_ = false;
  const Status released = open_and_release();
  if (!released) return released;
  const double sent_s = clock_.now_s();
  lost_.reset();
  do {
    clock_.wait_until(clock_.now_s() + options_.poll_s);
    const Status answered = await_status();
    if (!answered) return answered;
    connected_ = !status_.engaged && !status_.tripped && !status_.command_lost;
  } while (!connected_ && clock_.now_s() - sent_s <= options_.deadline_s);
  if (connected_) return Done{};
  return failure(IoErrc::refused, status_.tripped ? "connect: tripped" : "connect: not released");
}

Status CanBrake::set_torque(double torque_Nm) {
  const double max_Nm = options_.limits.max_torque_Nm;
  if (!(torque_Nm >= 0 && torque_Nm <= max_Nm)) {
    throw std::invalid_argument(
        fmt::format("CanBrake::set_torque: {} N·m is not within 0 to {}", torque_Nm, max_Nm));
  }
  if (!connected_) return failure(IoErrc::disconnected, "set torque");
  if (lost_) return *lost_;
  return send(torque_Nm, true);
}

Result<BrakeStatus> CanBrake::read() {
  if (!connected_) return failure(IoErrc::disconnected, "read");
  const Status answered = await_status();
  if (!answered) return answered.error();
  return BrakeStatus{.torque_Nm = status_.torque_Nm,
                     .tripped = status_.tripped || status_.command_lost,
                     .time_s = fresh_s_};
}

// A link that was lost stays so until it is opened, and the brake at its other end holds on: it is
// opened for this command, and for no torque before connect().
Status CanBrake::release() noexcept {
  try {
    if (!was_opened_) return failure(IoErrc::disconnected, "release");
    Status sent = send(0, false);
    if (sent || sent.error().code != IoErrc::disconnected) return sent;
    return open_and_release();
  } catch (...) {
    // Out of memory: the brake releases by itself when commands stop coming.
    return IoError{IoErrc::disconnected, {}};
  }
}

Status CanBrake::open_and_release() {
  const Status opened = transport_->open();
  if (!opened) return opened;
  was_opened_ = true;
  drop_waiting_frames(*transport_);
  has_status_ = saw_repeats_ = false;
  fresh_s_ = clock_.now_s();
  return send(0, false);
}

Status CanBrake::send(double torque_Nm, bool enable) {
  Status sent = transport_->send(
      can_frames::frame_from_brake_command({torque_Nm, enable, ++command_counter_}));
  if (!sent && sent.error().code == IoErrc::disconnected) lost_ = sent.error();
  return sent;
}

// Keeps the newest status.
Status CanBrake::take(const CanFrame& frame) {
  const auto status = can_frames::brake_status_from_frame(frame);
  if (!status) return failure(IoErrc::bad_reply, "read: not a status frame");
  if (has_status_ && status->counter == status_.counter) {
    saw_repeats_ = true;
    return Done{};
  }
  status_ = *status;
  has_status_ = true;
  saw_repeats_ = false;
  fresh_s_ = frame.time_s;
  return Done{};
}

Status CanBrake::await_status() {
  for (;;) {
    const Status taken =
        take_waiting_frames(*transport_, [this](const CanFrame& frame) { return take(frame); });
    if (!taken) {
      drop_waiting_frames(*transport_);
      return taken;
    }
    const double now_s = clock_.now_s();
    if (now_s - fresh_s_ > options_.deadline_s) {
      return saw_repeats_ ? failure(IoErrc::stale, "read: the counter stands still")
                          : failure(IoErrc::timeout, "read: no status");
    }
    if (has_status_) return Done{};
    clock_.wait_until(now_s + options_.poll_s);
  }
}

}  // namespace rvbench::hal
