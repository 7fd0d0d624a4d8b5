#include "sim/remote_io_device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace rvbench::sim {
namespace {

constexpr double broken_wire_degC = 850;  // the end of a Pt100's range

std::uint16_t temperature_word(double temp_degC) {
  const double shown_degC = std::isfinite(temp_degC) ? temp_degC : broken_wire_degC;
  const double tenths = std::clamp(std::round(10 * shown_degC), -2000.0, 8500.0);
  return static_cast<std::uint16_t>(static_cast<std::int16_t>(tenths));
}

ModbusAnswer part_of(std::span<const std::uint16_t> table, const ModbusRequest& request) {
  if (request.count == 0) return {modbus_exceptions::illegal_value};
  if (std::size_t{request.address} + request.count > table.size()) {
    return {modbus_exceptions::illegal_address};
  }
  const auto part = table.subspan(request.address, request.count);
  return {0, {part.begin(), part.end()}};
}

}  // namespace

void RemoteIoDevice::show(const hal::SafetyStatus& status) {
  const std::lock_guard lock(mutex_);
  status_ = status;
}

ModbusAnswer RemoteIoDevice::carry_out(const ModbusRequest& request) {
  const hal::SafetyStatus now = [this] {
    const std::lock_guard lock(mutex_);
    return status_;
  }();
  switch (request.function) {
    case modbus_functions::read_discrete_inputs: {
      std::array<std::uint16_t, 8> bits{};
      bits[0] = now.estop_pressed ? 0 : 1;
      bits[1] = now.guard_open ? 0 : 1;
      return part_of(bits, request);
    }
    case modbus_functions::read_input_registers: {
      const std::array words{temperature_word(now.housing_temp_degC)};
      return part_of(words, request);
    }
    default: return {modbus_exceptions::illegal_function};
  }
}

}  // namespace rvbench::sim
