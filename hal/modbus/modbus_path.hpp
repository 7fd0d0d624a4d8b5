#pragma once

#include <cstdint>
#include <string>
#include <variant>

namespace rvbench::hal {

/// Modbus TCP.
struct ModbusTcp {
  std::string host = "127.0.0.1";  ///< IPv4 address
  std::uint16_t port = 502;
};

/// Modbus RTU over a serial line, 8 data bits. The adapter turns its own direction around.
struct ModbusRtu {
  std::string device;  ///< "/dev/ttyUSB0"
  int baud = 9600;
  char parity = 'N';  ///< 'N', 'E' or 'O'
  int stop_bits = 1;
};

/// Where a drive listens.
using ModbusPath = std::variant<ModbusTcp, ModbusRtu>;

}  // namespace rvbench::hal
