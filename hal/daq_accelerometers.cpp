#include "hal/daq_accelerometers.hpp"

#include <string>

#include "hal/types/require_positive.hpp"

namespace rvbench::hal {
namespace {

IoError failure(IoErrc code, const char* what) {
  return {code, std::string("accelerometers: ") + what};
}

}  // namespace

DaqAccelerometers::DaqAccelerometers(PlantPort& port, Clock& clock, double deadline_s)
    : port_(port), clock_(clock), deadline_s_(deadline_s) {
  require_positive(deadline_s, "DaqAccelerometers", "deadline_s");
}

const std::vector<ChannelInfo>& DaqAccelerometers::channels() const {
  return port_.acceleration_channels();
}

Status DaqAccelerometers::connect() {
  connected_ = true;
  running_ = false;
  return Done{};
}

Status DaqAccelerometers::start() {
  if (!connected_) return failure(IoErrc::disconnected, "start");
  (void)port_.take_accelerations();  // what came before start() is not asked for
  fresh_s_ = clock_.now_s();
  running_ = true;
  return Done{};
}

Result<AccelerationBlock> DaqAccelerometers::read() {
  if (!running_) return failure(IoErrc::disconnected, "read: not started");
  AccelerationBlock block = port_.take_accelerations();
  if (block.scans.rows() > 0) {
    if (block.scans.cols() != static_cast<Eigen::Index>(channels().size())) {
      return failure(IoErrc::bad_reply, "read: wrong number of channels");
    }
    fresh_s_ = clock_.now_s();
  } else if (clock_.now_s() - fresh_s_ > deadline_s_) {
    return failure(IoErrc::timeout, "read: no scan");
  }
  return block;
}

}  // namespace rvbench::hal
