#include "sequences/fresh_values.hpp"

#include <cmath>
#include <utility>

namespace rvbench::sequences {
namespace {

template <typename T>
void take_newer(std::optional<T>& value, std::optional<T>&& later) {
  if (later) value = std::move(later);
}

void take_newer(FreshValues& all, FreshValues&& later) {
  take_newer(all.drive, std::move(later.drive));
  take_newer(all.brake, std::move(later.brake));
  take_newer(all.safety, std::move(later.safety));
  all.torque_rate_Hz = later.torque_rate_Hz;
  all.acceleration_rate_Hz = later.acceleration_rate_Hz;
  if (std::isfinite(later.speed_rpm)) all.speed_rpm = later.speed_rpm;
  if (!std::isfinite(later.angle_s)) return;
  all.angle_s = later.angle_s;
  all.angle_rad = later.angle_rad;
  all.torque_mean_Nm = later.torque_mean_Nm;
}

std::optional<hal::TorqueBlock> joined_torque(std::vector<FreshValues>& rounds) {
  std::optional<hal::TorqueBlock> all;
  for (FreshValues& round : rounds) {
    if (!round.torque) continue;
    if (!all) {
      all = std::move(round.torque);
      continue;
    }
    all->samples.insert(all->samples.end(), round.torque->samples.begin(),
                        round.torque->samples.end());
    all->lost += round.torque->lost;
    all->time_uncertainty_s = std::fmax(all->time_uncertainty_s, round.torque->time_uncertainty_s);
  }
  return all;
}

std::optional<hal::AccelerationBlock> joined_accelerations(std::vector<FreshValues>& rounds) {
  std::optional<hal::AccelerationBlock> all;
  Eigen::Index scans = 0;
  for (const FreshValues& round : rounds) {
    if (round.accelerations) scans += round.accelerations->scans.rows();
  }
  Eigen::Index from = 0;
  for (FreshValues& round : rounds) {
    if (!round.accelerations) continue;
    hal::AccelerationBlock& block = *round.accelerations;
    if (!all && block.scans.rows() == scans) return std::move(block);
    if (!all) {
      all.emplace();
      all->t0_s = block.t0_s;
      all->scans.resize(scans, block.scans.cols());
    }
    all->scans.middleRows(from, block.scans.rows()) = block.scans;
    all->lost += block.lost;
    all->time_uncertainty_s = std::fmax(all->time_uncertainty_s, block.time_uncertainty_s);
    from += block.scans.rows();
  }
  return all;
}

}  // namespace

FreshValues merged(std::vector<FreshValues> rounds) {
  FreshValues all;
  all.torque = joined_torque(rounds);
  all.accelerations = joined_accelerations(rounds);
  for (FreshValues& round : rounds) take_newer(all, std::move(round));
  return all;
}

}  // namespace rvbench::sequences
