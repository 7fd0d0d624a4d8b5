#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "hal/modbus/drive_profile_json.hpp"
#include "hal/modbus/modbus_inverter.hpp"
#include "hal/steady_clock.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

namespace {

// Sends whatever it is given to whoever connects, and hangs up.
class Babbler {
 public:
  Babbler() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    test::must(::bind(listener_, any, size) == 0 && ::listen(listener_, 16) == 0 &&
               ::getsockname(listener_, any, &size) == 0);
    port_ = ntohs(address.sin_port);
  }
  ~Babbler() { ::close(listener_); }
  Babbler(const Babbler&) = delete;
  Babbler& operator=(const Babbler&) = delete;

  std::uint16_t port() const { return port_; }

  void answer(const std::uint8_t* data, std::size_t size) const {
    const int client = ::accept(listener_, nullptr, nullptr);
    std::array<std::uint8_t, 64> request{};
    if (::read(client, request.data(), request.size()) > 2) {
      // Most replies are to be taken for an answer to what was asked.
      std::string reply = test::text_of(data, size);
      for (std::size_t i = 0; i < 2 && i < reply.size(); ++i) {
        reply[i] = static_cast<char>(request[i]);
      }
      (void)!::send(client, reply.data(), reply.size(), MSG_NOSIGNAL);
    }
    ::close(client);
  }

 private:
  int listener_;
  std::uint16_t port_ = 0;
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
