#include "sim/rv_bench.hpp"

#include <cmath>

namespace rvbench::sim {
namespace {

constexpr int substeps = static_cast<int>(rv_step_rate_Hz / RvBench::rate_Hz);  // per DAQ sample
constexpr int halves = 2;                   // housing steps per DAQ sample, for the decimator
constexpr double sensor_noise_m_s2 = 0.01;  // rms, of sensor, cable and DAQ together: assumed
constexpr double settling_s = 1;            // 18 time constants of the slowest mode

}  // namespace

RvBench::RvBench(const RvUnit& unit, const PlantSpec& plant)
    : unit_(unit),
      train_(plant, unit, 1 / (rate_Hz * substeps)),
      contacts_(unit, train_, halves * rate_Hz),
      housing_(unit.modes, halves * rate_Hz),
      tap_(halves * rate_Hz),
      decimator_(sensors),
      accelerations_(Eigen::VectorXd::Zero(halves * sensors)),
      sensor_engine_(unit.noise_seed + 2) {
  settle();
}

// Errors and preloads push from the first step on: what that stirs up dies out before the bench is
// handed over.
void RvBench::settle() {
  Eigen::VectorXf scan(sensors);
  const auto scans = static_cast<int>(settling_s * rate_Hz);
  for (int i = 0; i < scans; ++i) step(scan);
}

void RvBench::step_housing(Eigen::Ref<Eigen::VectorXd> accelerations_m_s2) {
  if (tap_.is_over()) return housing_.step(contacts_.forces_N(train_), accelerations_m_s2);
  Eigen::VectorXd forces_N = contacts_.forces_N(train_);
  forces_N.segment<3>(ports::input_bearing).array() += tap_.step() / std::sqrt(3.0);
  housing_.step(forces_N, accelerations_m_s2);
}

void RvBench::step(Eigen::Ref<Eigen::VectorXf> accelerations_m_s2) {
  for (int half = 0; half < halves; ++half) {
    for (int i = 0; i < substeps / halves; ++i) train_.step();
    step_housing(accelerations_.segment(half * sensors, sensors));
  }
  train_.wrap();
  decimator_.step(accelerations_.head(sensors), accelerations_.tail(sensors), accelerations_m_s2);
  const auto noise = static_cast<float>(sensor_noise_m_s2 * unit_.noise_level_factor);
  for (Eigen::Index i = 0; i < sensors; ++i) {
    const auto gain = static_cast<float>(unit_.sensor_gains[static_cast<std::size_t>(i)]);
    accelerations_m_s2[i] = gain * accelerations_m_s2[i] + noise * sensor_noise_(sensor_engine_);
  }
}

}  // namespace rvbench::sim
