#include "sim/inverter_device.hpp"

#include "sim/inverter_table.hpp"

namespace rvbench::sim {

ModbusAnswer InverterDevice::carry_out(const ModbusRequest& request) {
  using namespace modbus_functions;
  switch (request.function) {
    case read_holding_registers: {
      const auto values = read_table(model_, request.address, request.count);
      return values ? ModbusAnswer{0, *values} : ModbusAnswer{modbus_exceptions::illegal_address};
    }
    case write_single_register:
    case write_multiple_registers:
      return {static_cast<int>(write_table(model_, request.address, request.values)),
              request.values};
    default: return {modbus_exceptions::illegal_function};
  }
}

}  // namespace rvbench::sim
