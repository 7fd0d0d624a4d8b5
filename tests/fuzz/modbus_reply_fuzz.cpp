#include <array>
#include <thread>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"
#include "hal/steady_clock.hpp"
#include "tests/fuzz/scratch_file.hpp"
#include "tests/support/loopback.hpp"

using namespace rvbench;

namespace {

// Sends whatever it is given to whoever connects, and hangs up.
class Babbler {
 public:
  std::uint16_t port() const { return test::port_of(listener_); }

  void answer(const std::uint8_t* data, std::size_t size) const {
    const test::Socket client = test::accepted(listener_);
    std::array<std::uint8_t, 64> request{};
    if (::read(client.number(), request.data(), request.size()) > 2) {
      // Most replies are to be taken for an answer to what was asked.
      std::string reply = test::text_of(data, size);
      for (std::size_t i = 0; i < 2 && i < reply.size(); ++i) {
        reply[i] = static_cast<char>(request[i]);
      }
      (void)!::send(client.number(), reply.data(), reply.size(), MSG_NOSIGNAL);
    }
  }

 private:
  test::Socket listener_ = test::listening_socket();
};

}  // namespace

// A stranger answers for the drive. Nothing it says makes the driver believe that it connected.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Babbler babbler;
  static hal::SteadyClock clock;
  hal::ModbusInverter drive({.profile = hal::drive_profile("rvbench_generic"),
                             .path = hal::ModbusTcp{"127.0.0.1", babbler.port()},
                             .response_timeout_s = 0.02},
                            clock);
  std::jthread answering([&] { babbler.answer(data, size); });
  test::must(!drive.connect());
  return 0;
}
