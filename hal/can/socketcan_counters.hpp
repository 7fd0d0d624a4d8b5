#pragma once

#include <string>

#include "hal/bus_monitor.hpp"

namespace rvbench::hal {

/// The counters that Linux keeps of a network interface: those of any interface (rx_errors,
/// rx_dropped, tx_fifo_errors, ...) and, where there is a CAN controller, the controller's
/// (bus_error, error_warning, error_passive, bus_off, restarts). vcan has none.
///
/// Errors  disconnected: no such interface, or it cannot be asked
/// Source  Linux, if_link.h (rtnl_link_stats64) and can/netlink.h (can_device_stats)
class SocketcanCounters final : public BusMonitor {
 public:
  explicit SocketcanCounters(std::string interface) : interface_(std::move(interface)) {}
  Result<BusCounters> read() override;

 private:
  IoError failure(const char* operation, int error) const;

  std::string interface_;
};

}  // namespace rvbench::hal
