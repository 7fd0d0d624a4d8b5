#include "hal/can/slcan_transport.hpp"

#include <fmt/format.h>

#include "hal/can/serial_line.hpp"
#include "hal/can/slcan_frames.hpp"
#include "hal/can/slcan_link.hpp"
#include "hal/types/require.hpp"

namespace rvbench::hal {
namespace {

class SlcanMonitor final : public BusMonitor {
 public:
  explicit SlcanMonitor(std::shared_ptr<SlcanLink> link) : link_(std::move(link)) {}
  Result<BusCounters> read() override { return link_->count(); }

 private:
  std::shared_ptr<SlcanLink> link_;
};

}  // namespace

SlcanTransport::SlcanTransport(const SlcanOptions& options, const Clock& clock) {
  constexpr Require require{"SlcanTransport"};
  require(!options.device.empty(), "no device");
  require(slcan_frames::command_from_bitrate(options.bitrate_kbit_s).has_value(),
          fmt::format("bitrate_kbit_s is {}, must be 10, 20, 50, 100, 125, 250, 500, 800 or 1000",
                      options.bitrate_kbit_s));
  require(SerialLine::knows_baud(options.baud),
          fmt::format("baud is {}, no rate of a serial line", options.baud));
  for (const std::uint32_t id : options.ids) {
    require(id <= 0x7FF, fmt::format("identifier 0x{:X} is above 0x7FF", id));
  }
  link_ = std::make_shared<SlcanLink>(options, clock);
}

SlcanTransport::~SlcanTransport() { link_->close(); }

Status SlcanTransport::open() { return link_->open(); }

Status SlcanTransport::send(const CanFrame& frame) { return link_->send(frame); }

Result<CanFrame> SlcanTransport::receive() { return link_->receive(); }

std::unique_ptr<BusMonitor> SlcanTransport::monitor() const {
  return std::make_unique<SlcanMonitor>(link_);
}

}  // namespace rvbench::hal
