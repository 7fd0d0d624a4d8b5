#include "sequences/point_recorder.hpp"

#include <algorithm>
#include <cmath>

#include "hal/types/units.hpp"

namespace rvbench::sequences {
namespace {

// A lost frame of the torque sensor now and then harms nothing: its angle goes on.
constexpr double most_torque_lost = 0.01;

}  // namespace

void PointRecorder::open(int point) {
  so_far_ = {};
  is_open_ = true;
  point_ = point;
}

Status PointRecorder::take(const FreshValues& fresh) {
  if (!is_open_) return Done{};
  if (fresh.accelerations) {
    const hal::AccelerationBlock& block = *fresh.accelerations;
    if (std::isnan(so_far_.t0_s)) so_far_.t0_s = block.t0_s;
    so_far_.accelerations_end_s =
        block.t0_s + double(block.scans.rows()) / fresh.acceleration_rate_Hz;
    so_far_.scans_lost += block.lost;
    if (Status written = recording_.append(point_, block); !written) return written;
  }
  if (fresh.torque) {
    const hal::TorqueBlock& block = *fresh.torque;
    so_far_.torque_lost += block.lost;
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
}

bool PointRecorder::covers(double input_turns) const {
  if (!(so_far_.last_s > so_far_.first_s)) return false;
  // The part of the angle that the accelerations, which may lag, cover as well.
  const double share = (std::min(so_far_.last_s, so_far_.accelerations_end_s) - so_far_.first_s) /
                       (so_far_.last_s - so_far_.first_s);
  return std::abs(so_far_.last_rad - so_far_.first_rad) * share >= input_turns * units::two_pi;
}

Result<hal::PointResult> PointRecorder::close(std::string status, double least_torque_Nm) {
  is_open_ = false;
  hal::PointResult result{point_, so_far_.t0_s, std::move(status), not_known, not_known};
  if (so_far_.last_s > so_far_.first_s) {
    result.speed_rpm = units::rpm_from_rad_s((so_far_.last_rad - so_far_.first_rad) /
                                             (so_far_.last_s - so_far_.first_s));
    result.torque_Nm = so_far_.torque_sum_Nm / double(so_far_.torque_known);
  }
  const bool too_much_lost =
      so_far_.scans_lost > 0 ||
      double(so_far_.torque_lost) > most_torque_lost * double(so_far_.torque_samples);
  if (result.status == "ok" && too_much_lost) result.status = "samples_lost";
  const double driving_Nm = std::copysign(1.0, result.speed_rpm) * result.torque_Nm;
  if (result.status == "ok" && driving_Nm < least_torque_Nm) result.status = "torque_implausible";
  if (Status written = recording_.end_point(result); !written) return written.error();
  return result;
}

}  // namespace rvbench::sequences
