#pragma once

#include "hal/accelerometers.hpp"
#include "hal/mirror_world.hpp"

namespace rvbench::hal {

/// Four triaxial accelerometers on a housing that never moves, but for the world's faults.
class MirrorAccelerometers final : public Accelerometers {
 public:
  explicit MirrorAccelerometers(MirrorWorld& world);

  const std::vector<ChannelInfo>& channels() const override { return channels_; }
  double range_m_s2() const override { return world_.options().acceleration_range_m_s2; }
  double rate_Hz() const override { return world_.options().acceleration_rate_Hz; }
  Status connect() override;
  Status start() override;
  Result<AccelerationBlock> read() override;
  void stop() noexcept override { started_ = false; }

 private:
  long scans_due() const;
  void spoil(AccelerationBlock& block) const;

  MirrorWorld& world_;
  std::vector<ChannelInfo> channels_;
  bool connected_ = false;
  bool started_ = false;
  long sent_ = 0;
  AccelerationBlock last_;
};

}  // namespace rvbench::hal
