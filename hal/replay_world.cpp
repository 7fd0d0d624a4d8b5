#include "hal/replay_world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::hal {
namespace {

const Channel& angle_of(const Recording& recording) {
  return *recording.find(channel_names::input_angle);
}

const Channel& torque_of(const Recording& recording) {
  return *recording.find(channel_names::input_torque);
}

// i modulo count, not negative.
Eigen::Index wrapped(long i, Eigen::Index count) { return (i % count + count) % count; }

// The angle that `count` samples cover on average; 0 if fewer than two of them are known.
double angle_of_one_round(const Eigen::VectorXd& angle_rad) {
  Eigen::Index first = 0;
  Eigen::Index last = angle_rad.size() - 1;
  while (first < last && std::isnan(angle_rad[first])) ++first;
  while (last > first && std::isnan(angle_rad[last])) --last;
  if (last <= first) return 0;
  return (angle_rad[last] - angle_rad[first]) / static_cast<double>(last - first) *
         static_cast<double>(angle_rad.size());
}

double or_else(double value, double fallback) { return std::isnan(value) ? fallback : value; }

}  // namespace

ReplayWorld::ReplayWorld(std::unique_ptr<RecordingReader> reader, const ReplayOptions& options,
                         const Clock& clock)
    : reader_(std::move(reader)), options_(options), clock_(clock) {
  for (const PointResult& result : reader_->results()) {
    const auto index = static_cast<std::size_t>(result.point);
    if (result.status == "unsettled" || index >= layout().points.size()) continue;
    const PlannedPoint& plan = layout().points[index];
    playable_.push_back({result.point, or_else(plan.speed_rpm, result.speed_rpm), plan.load_pct});
  }
  accelerations_.rate_Hz = layout().acceleration_rate_Hz;
  torque_.rate_Hz = layout().torque_rate_Hz;
}

void ReplayWorld::command_speed(double speed_rpm) {
  const std::lock_guard lock(mutex_);
  if (speed_rpm != speed_rpm_) commanded_s_ = clock_.now_s();
  speed_rpm_ = speed_rpm;
}

void ReplayWorld::command_brake(double torque_Nm) {
  const std::lock_guard lock(mutex_);
  if (torque_Nm != brake_Nm_) commanded_s_ = clock_.now_s();
  brake_Nm_ = torque_Nm;
}

double ReplayWorld::fastest_rpm() const {
  double fastest = 0;
  for (const Playable& point : playable_) fastest = std::max(fastest, std::abs(point.speed_rpm));
  return fastest;
}

double ReplayWorld::measured_speed_rpm() {
  const std::lock_guard lock(mutex_);
  if (follow_command() || !playing_) return playing_ ? not_known : 0;
  return recording_.speed_rpm;
}

double ReplayWorld::brake_torque_Nm() {
  const std::lock_guard lock(mutex_);
  if (follow_command() || !playing_) return brake_Nm_;
  return or_else(playable_[*playing_].load_pct / 100 * options_.rated_output_torque_Nm, brake_Nm_);
}

Result<AccelerationBlock> ReplayWorld::take_accelerations() {
  const std::lock_guard lock(mutex_);
  if (const auto error = follow_command()) return *error;
  const auto channels = static_cast<Eigen::Index>(layout().acceleration_channels.size());
  const long end = due(accelerations_);
  AccelerationBlock block;
  block.t0_s = static_cast<double>(accelerations_.sent) / accelerations_.rate_Hz;
  block.scans.setZero(end - accelerations_.sent, channels);
  for (Eigen::Index c = 0; playing_ && c < channels; ++c) {
    const auto& name = layout().acceleration_channels[static_cast<std::size_t>(c)].name;
    const Eigen::VectorXd& samples = recording_.find(name)->samples;
    for (Eigen::Index i = 0; i < block.scans.rows(); ++i) {
      const long number = accelerations_.sent + i + accelerations_.offset;
      block.scans(i, c) = static_cast<float>(samples[wrapped(number, samples.size())]);
    }
  }
  block.lost = static_cast<int>(block.scans.array().isNaN().rowwise().any().count());
  accelerations_.sent = end;
  return block;
}

Result<TorqueBlock> ReplayWorld::take_torque() {
  const std::lock_guard lock(mutex_);
  if (const auto error = follow_command()) return *error;
  TorqueBlock block;
  block.t0_s = static_cast<double>(torque_.sent) / torque_.rate_Hz;
  for (const long end = due(torque_); torque_.sent < end; ++torque_.sent) {
    block.samples.push_back(sample(torque_.sent));
    if (std::isnan(block.samples.back().torque_Nm)) ++block.lost;
  }
  return block;
}

// Number of samples due by now; the small amount is for times that are sums of ticks.
long ReplayWorld::due(const Track& track) const {
  return std::lround(std::floor(clock_.now_s() * track.rate_Hz + 1e-6));
}

TorqueSample ReplayWorld::sample(long number) {
  if (!playing_) return {0, angle_rad_};
  const Eigen::VectorXd& angle = angle_of(recording_).samples;
  const long index = number + torque_.offset;
  const Eigen::Index at = wrapped(index, angle.size());
  const double rounds = static_cast<double>((index - at) / angle.size());
  const double now_rad = base_rad_ + rounds * turn_rad_ + angle[at];
  if (!std::isnan(now_rad)) angle_rad_ = now_rad;
  return {torque_of(recording_).samples[at], now_rad};
}

// Takes up the commands at the first look after them: speed and torque come one after the other.
std::optional<IoError> ReplayWorld::follow_command() {
  if (speed_rpm_ == followed_speed_rpm_ && brake_Nm_ == followed_brake_Nm_) return std::nullopt;
  followed_speed_rpm_ = speed_rpm_;
  followed_brake_Nm_ = brake_Nm_;
  const std::optional<std::size_t> before = std::exchange(playing_, std::nullopt);
  const bool was_played = commanded_s_ - played_from_s_ > options_.lead_in_s;
  if (before == next_ && was_played) next_ = (next_ + 1) % playable_.size();
  if (speed_rpm_ == 0) return std::nullopt;
  const std::size_t chosen = nearest();
  Result<Recording> read = reader_->read(playable_[chosen].number);
  if (!read) return read.error();
  start_playing(chosen, std::move(read).value());
  return std::nullopt;
}

// Nearest to the command, speed before load; of equal ones the first from next_ on.
std::size_t ReplayWorld::nearest() const {
  const double load_pct = 100 * brake_Nm_ / options_.rated_output_torque_Nm;
  const auto distance = [&](std::size_t i) {
    const Playable& point = playable_[i];
    return std::pair(std::round(std::abs(or_else(point.speed_rpm, speed_rpm_) - speed_rpm_)),
                     std::round(std::abs(or_else(point.load_pct, load_pct) - load_pct)));
  };
  std::size_t best = next_;
  for (std::size_t step = 1; step < playable_.size(); ++step) {
    const std::size_t i = (next_ + step) % playable_.size();
    if (distance(i) < distance(best)) best = i;
  }
  return best;
}

void ReplayWorld::start_playing(std::size_t chosen, Recording recording) {
  recording_ = std::move(recording);
  playing_ = chosen;
  const double first_scan_s = recording_.find(layout().acceleration_channels.front().name)->start_s;
  // Both tracks keep the distance in time that they had when they were recorded.
  played_from_s_ = commanded_s_;
  const double from_s = commanded_s_ + options_.lead_in_s;
  const double apart_s = angle_of(recording_).start_s - first_scan_s;
  const double torque_from_s = from_s + std::clamp(or_else(apart_s, 0), -1.0, 1.0);
  accelerations_.offset = -std::lround(from_s * accelerations_.rate_Hz);
  torque_.offset = -std::lround(torque_from_s * torque_.rate_Hz);

  const double before_rad = angle_rad_;
  turn_rad_ = angle_of_one_round(angle_of(recording_).samples);
  base_rad_ = 0;
  const double step_rad = turn_rad_ / static_cast<double>(angle_of(recording_).samples.size());
  const double first_rad = sample(torque_.sent).angle_rad;
  base_rad_ = std::isnan(first_rad) ? 0 : before_rad + step_rad - first_rad;
}

}  // namespace rvbench::hal
