#include <modbus/modbus.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <memory>

#include "sim/inverter_device.hpp"
#include "sim/modbus_requests.hpp"
#include "tests/fuzz/scratch_file.hpp"

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
  std::array<int, 2> line{};
  test::must(::socketpair(AF_UNIX, SOCK_STREAM, 0, line.data()) == 0);
  (void)!::write(line[0], data, size);
  ::shutdown(line[0], SHUT_WR);
  while (requests.serve(context.get(), line[1])) {
  }
  ::close(line[0]);
  ::close(line[1]);
  test::must(model.state().setpoint_Hz >= 0);
  test::must(model.state().setpoint_Hz <= model.parameters().max_frequency_Hz);
  return 0;
}
