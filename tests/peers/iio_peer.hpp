#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <string>

#include "hal/daq/iio_accelerometers.hpp"
#include "tests/support/program.hpp"

namespace rvbench::test {

/// A port that nobody listens at, now.
inline std::uint16_t free_port() {
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  (void)::bind(socket, reinterpret_cast<const sockaddr*>(&address), size);
  (void)::getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size);
  ::close(socket);
  return ntohs(address.sin_port);
}

/// Debian's iiod over a make-believe device.
class Iiod {
 public:
  /// @throws std::runtime_error with the reason, where it cannot run
  Iiod(double rate_Hz, int channels, const std::string& format = "le:s32/32>>0")
      : port_(free_port()),
        program_(".", {RVBENCH_IIO_STANDIN, std::to_string(port_), std::to_string(rate_Hz),
                       std::to_string(channels), format}) {
    if (!program_.says("serving at ")) {
      throw std::runtime_error("iiod needs root and the package iiod: " + program_.said());
    }
  }

  std::string uri() const { return "ip:127.0.0.1:" + std::to_string(port_); }
  test::Program& program() { return program_; }

 private:
  std::uint16_t port_;
  test::Program program_;
};

/// All inputs of an Iiod, in m/s² of 0.25 per count.
inline hal::IioOptions options_of(const Iiod& iiod, double rate_Hz, int channels) {
  hal::IioOptions options;
  options.uri = iiod.uri();
  options.device = "standin";
  options.rate_Hz = rate_Hz;
  options.range_m_s2 = 1e9;
  for (int i = 0; i < channels; ++i) {
    hal::DaqInput input;
    input.device_channel = "voltage" + std::to_string(i);
    input.info = {"accel_" + std::to_string(i), "m/s²", "+X"};
    input.info.sensitivity = 1e-3;  // V per m/s²: of a voltage in mV the same number
    options.inputs.push_back(input);
  }
  return options;
}

/// What iio_standin makes of scan n in channel c.
inline float standin_m_s2(long n, int c) { return 0.25F * float(n % 65536 * 32 + c); }

}  // namespace rvbench::test
