#pragma once

#include <modbus/modbus.h>

#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>

namespace rvbench::test {

/// libmodbus by itself: a Modbus master that knows nothing of rvbench. Asks unit 1.
class BareMaster {
 public:
  /// @param context  of modbus_new_tcp or modbus_new_rtu, which it closes and frees
  /// @throws std::runtime_error if it does not connect
  explicit BareMaster(modbus_t* context, double timeout_s = 0.5) : context_(context) {
    modbus_set_slave(context, 1);
    modbus_set_response_timeout(context, 0, static_cast<std::uint32_t>(1e6 * timeout_s));
    if (modbus_connect(context) != 0) throw std::runtime_error("libmodbus does not connect");
  }

  /// Holding registers. @return false if they were not told
  bool read(std::uint16_t address, std::span<std::uint16_t> words) {
    const int count = static_cast<int>(words.size());
    return modbus_read_registers(context_.get(), address, count, words.data()) == count;
  }

 private:
  struct CloseAndFree {
    void operator()(modbus_t* context) const {
      modbus_close(context);
      modbus_free(context);
    }
  };
  std::unique_ptr<modbus_t, CloseAndFree> context_;
};

}  // namespace rvbench::test
