#include "hal/can/can_torque_sensor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hal/can/torque_transducer.hpp"
#include "hal/can/waiting_frames.hpp"
#include "hal/types/require_positive.hpp"
#include "hal/types/units.hpp"

namespace rvbench::hal {
namespace {

constexpr double most_early_samples = 16;     // jitter of those before
constexpr double slowest_clock_share = 1.01;  // of a transducer, against its stated period
// One that is slower yet is followed at this pace: a burst is over before it makes a difference.
constexpr double samples_to_follow = 4096;

std::string flaw(const can_frames::TorqueFrame& frame) {
  if (frame.overload) return "overload";
  if (frame.shunt_on) return torque_transducer::shunt_on;
  if (frame.zeroing) return torque_transducer::zeroing;
  return frame.flaw;
}

using torque_transducer::transducer_failure;

}  // namespace

CanTorqueSensor::CanTorqueSensor(std::unique_ptr<CanTransport> transport,
                                 const CanTorqueSensorOptions& options, Clock& clock)
    : transport_(std::move(transport)), options_(options), clock_(clock), track_(options.rate_Hz) {
  if (!transport_) throw std::invalid_argument("CanTorqueSensor: transport is null");
  require_positive(options.rate_Hz, "CanTorqueSensor", "rate_Hz");
  require_positive(options.deadline_s, "CanTorqueSensor", "deadline_s");
}

Status CanTorqueSensor::connect() {
  connected_ = false;
  const Status opened = transport_->open();
  if (!opened) return opened;
  drop_waiting_frames(*transport_);
  track_ = Track(options_.rate_Hz);
  saw_repeats_ = false;
  fresh_s_ = clock_.now_s();
  connected_ = true;
  const Result<TorqueBlock> first = read();
  if (first) return Done{};
  connected_ = false;
  return first.error();
}

Result<TorqueBlock> CanTorqueSensor::read() {
  if (!connected_) return transducer_failure(IoErrc::disconnected, "read");
  Track track = track_;
  TorqueBlock block;
  for (;;) {
    const Status taken = take_waiting_frames(
        *transport_, [&](const CanFrame& frame) { return take(frame, track, block); });
    if (!taken) {
      drop_waiting_frames(*transport_);
      return taken.error();
    }
    const double now_s = clock_.now_s();
    if (!block.samples.empty()) fresh_s_ = track.time_s;
    if (now_s - fresh_s_ > options_.deadline_s) {
      return saw_repeats_ ? transducer_failure(IoErrc::stale, "read: the counter stands still")
                          : transducer_failure(IoErrc::timeout, "read: no frame");
    }
    if (track.started) break;
    clock_.wait_until(now_s + 1 / options_.rate_Hz);
  }
  track_ = track;
  if (block.samples.empty()) return block;
  saw_repeats_ = false;
  block.t0_s = track.time_s - static_cast<double>(block.samples.size() - 1) / options_.rate_Hz;
  block.time_uncertainty_s = track.clock.uncertainty_s();
  return block;
}

Status CanTorqueSensor::take(const CanFrame& frame, Track& track, TorqueBlock& block) {
  const auto torque = options_.decode(frame);
  if (!torque) return transducer_failure(IoErrc::bad_reply, "read: not a torque frame");
  const std::string what = flaw(*torque);
  if (!what.empty()) return transducer_failure(IoErrc::bad_reply, what);
  append(*torque, frame.time_s, track, block);
  return Done{};
}

// Samples from the newest one to this one: 1 if none was lost, 0 or less if it is not new. The
// same frame again is never new, however long it took: that is a transducer that stands still,
// and not one of which exactly 255 samples were lost. A sample never comes before it was taken: 256
// more were lost only if so many periods have passed without any. One that comes later than it
// should was held up, and those behind it come in a burst.
std::int64_t CanTorqueSensor::samples_since(const Track& track,
                                            const can_frames::TorqueFrame& frame,
                                            double time_s) const {
  if (frame == track.newest) return 0;
  const int step = static_cast<std::uint8_t>(frame.counter - track.newest.counter);
  const double elapsed = (time_s - track.due_s) * options_.rate_Hz;
  const auto wraps =
      static_cast<std::int64_t>(std::floor((elapsed - step + most_early_samples) / 256));
  // Half a turn of the counter ahead of what has come: a turn was taken for lost that was not.
  const bool is_ahead = (track.time_s - time_s) * options_.rate_Hz + step > 128;
  return step + 256 * (is_ahead ? wraps - 1 : wraps);
}

void CanTorqueSensor::append(const can_frames::TorqueFrame& frame, double time_s, Track& track,
                             TorqueBlock& block) {
  if (!track.started) {
    track.started = true;
    track.clock.start(time_s);
    track.newest = frame;
    track.due_s = track.time_s = time_s;
    track.angle_turns = frame.angle_turns;
    block.samples.push_back({frame.torque_Nm, units::two_pi * track.angle_turns});
    return;
  }
  const std::int64_t steps = samples_since(track, frame, time_s);
  if (steps < 1) {
    saw_repeats_ = true;
    return;
  }
  block.samples.resize(block.samples.size() + static_cast<std::size_t>(steps - 1));
  block.lost += static_cast<int>(steps - 1);
  const auto samples = static_cast<double>(steps);
  const double expected_turns = track.angle_turns + samples * track.turns_per_sample;
  const double turns = frame.angle_turns + std::round(expected_turns - frame.angle_turns);
  track.newest = frame;
  const double due_s = track.due_s + slowest_clock_share * samples / options_.rate_Hz;
  const double follows = std::min(1.0, samples / samples_to_follow);
  track.due_s = std::min(time_s, due_s + follows * (time_s - due_s));
  track.time_s = track.clock.next(time_s, steps);
  track.turns_per_sample = (turns - track.angle_turns) / samples;
  track.angle_turns = turns;
  block.samples.push_back({frame.torque_Nm, units::two_pi * turns});
}

}  // namespace rvbench::hal
