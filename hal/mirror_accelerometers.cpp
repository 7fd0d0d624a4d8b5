#include "hal/mirror_accelerometers.hpp"

#include <cmath>

namespace rvbench::hal {

MirrorAccelerometers::MirrorAccelerometers(MirrorWorld& world) : world_(world) {
  for (const char place : {'1', '2', '3', '4'}) {
    for (const char axis : {'x', 'y', 'z'}) {
      const char upper = char(axis - 'a' + 'A');
      channels_.push_back({std::string("accel_") + place + axis, "m/s²", std::string("+") + upper,
                           0.0102});  // 100 mV/g
    }
  }
}

long MirrorAccelerometers::scans_due() const {
  return std::lround(std::floor(world_.clock().now_s() * rate_Hz() + 1e-6));
}

Status MirrorAccelerometers::connect() {
  if (world_.has(MirrorFault::accelerometers_dead)) {
    return IoError{IoErrc::timeout, "mirror accelerometers: connect"};
  }
  connected_ = true;
  return Done{};
}

Status MirrorAccelerometers::start() {
  if (!connected_) return IoError{IoErrc::disconnected, "mirror accelerometers: start"};
  started_ = true;
  sent_ = scans_due();
  return Done{};
}

Result<AccelerationBlock> MirrorAccelerometers::read() {
  if (!started_) return IoError{IoErrc::disconnected, "mirror accelerometers: read"};
  if (world_.has(MirrorFault::accelerometers_frozen)) return last_;
  if (world_.has(MirrorFault::accelerometers_dead)) {
    return IoError{IoErrc::timeout, "mirror accelerometers: read"};
  }
  const long due = scans_due();
  if (due == sent_) return AccelerationBlock{};
  last_.t0_s = double(sent_) / rate_Hz();
  last_.scans.setZero(due - sent_, Eigen::Index(channels_.size()));
  last_.lost = 0;
  spoil(last_);
  sent_ = due;
  return last_;
}

void MirrorAccelerometers::spoil(AccelerationBlock& block) const {
  if (world_.has(MirrorFault::shock)) block.scans(0, 0) = float(0.99 * range_m_s2());
  if (world_.has(MirrorFault::clipped)) block.scans.col(0).setConstant(float(range_m_s2()));
  if (!world_.has(MirrorFault::scans_lost)) return;
  for (Eigen::Index i = 0; i < block.scans.rows(); i += 2) {
    block.scans.row(i).setConstant(float(not_known));
    ++block.lost;
  }
}

}  // namespace rvbench::hal
