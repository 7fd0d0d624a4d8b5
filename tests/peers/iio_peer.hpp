#pragma once

#include <stdexcept>
#include <string>

#include "hal/daq/iio_accelerometers.hpp"
#include "tests/support/loopback.hpp"
#include "tests/support/program.hpp"
#include "tests/support/this_build.hpp"

namespace rvbench::test {

/// Debian's iiod over a make-believe device.
class Iiod {
 public:
  /// @throws std::runtime_error with the reason, where it cannot run
  Iiod(double rate_Hz, int channels, const std::string& format = "le:s32/32>>0")
      : port_(reserved_port()),
        program_(".", {(build_dir() / "tests/peers/iio_standin").string(),
                       std::to_string(port_of(port_)), std::to_string(rate_Hz),
                       std::to_string(channels), format}) {
    if (!program_.says("serving at ")) {
      throw std::runtime_error("iiod needs root and the package iiod: " + program_.said());
    }
  }

  std::string uri() const { return "ip:127.0.0.1:" + std::to_string(port_of(port_)); }
  test::Program& program() { return program_; }

 private:
  Socket port_;
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
