#pragma once

#include <cstdint>
#include <vector>

namespace rvbench::sim {

/// Modbus functions that the simulated devices may know.
namespace modbus_functions {
inline constexpr int read_discrete_inputs = 2;
inline constexpr int read_holding_registers = 3;
inline constexpr int read_input_registers = 4;
inline constexpr int write_single_register = 6;
inline constexpr int write_multiple_registers = 16;
}  // namespace modbus_functions

struct ModbusRequest {
  int function = 0;
  std::uint16_t address = 0;
  std::uint16_t count = 0;            ///< of bits or registers to read
  std::vector<std::uint16_t> values;  ///< of registers to write
};

/// Values that were read or written, a bit being 0 or 1; or an exception code that is not 0.
struct ModbusAnswer {
  int exception = 0;
  std::vector<std::uint16_t> values = {};
};

namespace modbus_exceptions {
inline constexpr int illegal_function = 1;
inline constexpr int illegal_address = 2;
inline constexpr int illegal_value = 3;
inline constexpr int busy = 6;
}  // namespace modbus_exceptions

/// What a simulated device does with a Modbus request, whichever line it came by. Called from the
/// serving threads of all lines at once.
class ModbusDevice {
 public:
  virtual ~ModbusDevice() = default;
  virtual void note_request() {}  ///< each valid one, also if the answer will be a bad one
  virtual ModbusAnswer carry_out(const ModbusRequest& request) = 0;
};

}  // namespace rvbench::sim
