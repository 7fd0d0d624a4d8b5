#include <modbus/modbus.h>

#include <memory>

#include "sim/inverter_device.hpp"
#include "sim/modbus_requests.hpp"
#include "tests/fuzz/scratch_file.hpp"
#include "tests/support/loopback.hpp"

using namespace rvbench;

// The simulated drive reads what anybody sends; whatever it is, the motor stays within its limits.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::unique_ptr<modbus_t, decltype(&modbus_free)> context(
      modbus_new_tcp("127.0.0.1", 0), modbus_free);
  modbus_set_byte_timeout(context.get(), 0, 1000);
  modbus_set_indication_timeout(context.get(), 0, 1000);
  sim::InverterModel model;
  sim::InverterDevice device(model);
  sim::ModbusRequests requests(device, 1);
  const auto [client, line] = test::connected_pair();
  (void)!::write(client.number(), data, size);
  ::shutdown(client.number(), SHUT_WR);
  while (requests.serve(context.get(), line.number())) {
  }
  test::must(model.state().setpoint_Hz >= 0);
  test::must(model.state().setpoint_Hz <= model.parameters().max_frequency_Hz);
  return 0;
}
