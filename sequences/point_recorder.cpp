#include "sequences/point_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::sequences {
namespace {

// A lost frame of the torque sensor now and then harms nothing: its angle goes on.
constexpr double most_torque_lost = 0.01;
constexpr double stretch_s = 1;        // short enough to show what befell a part of the record
constexpr double stretch_turns = 10;   // long enough for the ripple within a turn to even out
constexpr double lags_apart_s = 0.05;  // of two streams, besides their blocks: as good as stamps

}  // namespace

void PointRecorder::open(int point) {
  so_far_ = {};
  is_open_ = true;
  is_sealed_ = false;
  followed_until_s_ = not_known;
  point_ = point;
}

Status PointRecorder::take(const FreshValues& fresh) {
  if (!is_open_) return Done{};
  if (fresh.accelerations) {
    followed_until_s_ = fresh.accelerations->t0_s +
                        double(fresh.accelerations->scans.rows()) / fresh.acceleration_rate_Hz;
  }
  if (is_sealed_) return Done{};
  compare_streams(fresh);
  if (fresh.accelerations) {
    const hal::AccelerationBlock& block = *fresh.accelerations;
    if (std::isnan(so_far_.t0_s)) so_far_.t0_s = block.t0_s;
    so_far_.accelerations_end_s = followed_until_s_;
    so_far_.scans_lost += block.lost;
    so_far_.acceleration_time_uncertainty_s =
        std::fmax(so_far_.acceleration_time_uncertainty_s, block.time_uncertainty_s);
    if (Status written = recording_.append(point_, block); !written) return written;
  }
  if (fresh.torque) {
    const hal::TorqueBlock& block = *fresh.torque;
    so_far_.torque_lost += block.lost;
    so_far_.torque_time_uncertainty_s =
        std::fmax(so_far_.torque_time_uncertainty_s, block.time_uncertainty_s);
    for (std::size_t i = 0; i < block.samples.size(); ++i) {
      take_sample(block.t0_s + double(i) / fresh.torque_rate_Hz, block.samples[i]);
    }
    return recording_.append(point_, block);
  }
  return Done{};
}

void PointRecorder::take_sample(double time_s, const hal::TorqueSample& sample) {
  ++so_far_.torque_samples;
  if (!std::isfinite(sample.torque_Nm) || !std::isfinite(sample.angle_rad)) return;
  if (!(time_s >= so_far_.t0_s)) return;
  if (std::isnan(so_far_.first_s)) {
    so_far_.first_s = time_s;
    so_far_.first_rad = sample.angle_rad;
  }
  so_far_.last_s = time_s;
  so_far_.last_rad = sample.angle_rad;
  so_far_.torque_sum_Nm += sample.torque_Nm;
  ++so_far_.torque_known;
  take_stretch(time_s, sample);
}

void PointRecorder::take_stretch(double time_s, const hal::TorqueSample& sample) {
  Stretch& stretch = so_far_.stretch;
  if (stretch.samples == 0) stretch = {time_s, sample.angle_rad, 0, 0};
  stretch.torque_sum_Nm += sample.torque_Nm;
  ++stretch.samples;
  const double turned_rad = sample.angle_rad - stretch.from_rad;
  if (time_s - stretch.from_s < stretch_s || std::abs(turned_rad) < stretch_turns * units::two_pi) {
    return;
  }
  const double driving_Nm =
      std::copysign(1.0, turned_rad) * stretch.torque_sum_Nm / double(stretch.samples);
  so_far_.weakest_Nm = std::fmin(so_far_.weakest_Nm, driving_Nm);
  stretch = {};
}

// Both streams come at their own pace, in blocks: the lag swings by as much as a block is long. A
// lag that grows beyond that is a stream that left something out.
void PointRecorder::compare_streams(const FreshValues& fresh) {
  if (!fresh.accelerations || !fresh.torque) return;
  const double accelerations_s =
      double(fresh.accelerations->scans.rows()) / fresh.acceleration_rate_Hz;
  const double torque_s = double(fresh.torque->samples.size()) / fresh.torque_rate_Hz;
  const double lag_s =
      fresh.torque->t0_s + torque_s - (fresh.accelerations->t0_s + accelerations_s);
  so_far_.least_lag_s = std::fmin(so_far_.least_lag_s, lag_s);
  so_far_.most_lag_s = std::fmax(so_far_.most_lag_s, lag_s);
  so_far_.longest_block_s = std::max({so_far_.longest_block_s, accelerations_s, torque_s});
}

// Of a record that is too short for a stretch, the mean of the whole.
double PointRecorder::weakest_driving_Nm(const hal::PointResult& whole) const {
  if (std::isfinite(so_far_.weakest_Nm)) return so_far_.weakest_Nm;
  return std::copysign(1.0, whole.speed_rpm) * whole.torque_Nm;
}

bool PointRecorder::covers(double input_turns) const {
  if (!(so_far_.last_s > so_far_.first_s)) return false;
  // The part of the angle that the accelerations, which may lag, cover as well.
  const double share = (std::min(so_far_.last_s, so_far_.accelerations_end_s) - so_far_.first_s) /
                       (so_far_.last_s - so_far_.first_s);
  return std::abs(so_far_.last_rad - so_far_.first_rad) * share >= input_turns * units::two_pi;
}

bool PointRecorder::is_followed_for(double duration_s) const {
  return followed_until_s_ >= so_far_.accelerations_end_s + duration_s;
}

Result<hal::PointResult> PointRecorder::close(std::string status, double least_torque_Nm) {
  is_open_ = false;
  hal::PointResult result{.point = point_, .t0_s = so_far_.t0_s, .status = std::move(status)};
  result.acceleration_time_uncertainty_s = so_far_.acceleration_time_uncertainty_s;
  result.torque_time_uncertainty_s = so_far_.torque_time_uncertainty_s;
  if (so_far_.last_s > so_far_.first_s) {
    result.speed_rpm = units::rpm_from_rad_s((so_far_.last_rad - so_far_.first_rad) /
                                             (so_far_.last_s - so_far_.first_s));
    result.torque_Nm = so_far_.torque_sum_Nm / double(so_far_.torque_known);
  }
  const bool too_much_lost =
      so_far_.scans_lost > 0 ||
      double(so_far_.torque_lost) > most_torque_lost * double(so_far_.torque_samples);
  const bool has_gap = so_far_.most_lag_s - so_far_.least_lag_s >
                       lags_apart_s + so_far_.longest_block_s;  // false if not known
  if (result.status == "ok" && (too_much_lost || has_gap)) result.status = "samples_lost";
  if (result.status == "ok" && weakest_driving_Nm(result) < least_torque_Nm) {
    result.status = "torque_implausible";
  }
  if (Status written = recording_.end_point(result); !written) return written.error();
  return result;
}

}  // namespace rvbench::sequences
