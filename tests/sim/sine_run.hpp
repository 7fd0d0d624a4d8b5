#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "tests/sim/plant_texts.hpp"

namespace rvbench::test {

constexpr double sine_rate_Hz = 200;

/// 2 kg on 800 N/m and 8 N·s/m, 3.18 Hz: its way "x" and its speed "v" are seen.
inline sim::PlantSpec mass_on_spring() {
  return plant_of(mass_on(
      R"({"type": "spring", "body_a": "m",
          "parameters": {"stiffness": {"value": 800, "unit": "N/m"}}},
         {"type": "damper", "body_a": "m",
          "parameters": {"damping": {"value": 8, "unit": "N·s/m"}}})",
      "", "band_limited"));
}

/// 40 s of 3 N at this frequency, for the input "u".
inline std::vector<Channel> sine_of(double frequency_Hz) {
  Eigen::VectorXd push(8000);
  for (Eigen::Index i = 0; i < push.size(); ++i) {
    push[i] = 3 * std::cos(2 * std::numbers::pi * frequency_Hz * double(i) / sine_rate_Hz);
  }
  return {channel_of("u", "N", sine_rate_Hz, push)};
}

/// The line of a channel from 25 to 35 s: what was there at the start is over, the end is not seen.
/// @param frequency_Hz  a multiple of 0.1 Hz
inline std::complex<double> settled_line(const Channel& channel, double frequency_Hz) {
  std::complex<double> line = 0;
  for (Eigen::Index i = 5000; i < 7000; ++i) {
    const double turned_rad = 2 * std::numbers::pi * frequency_Hz * double(i) / sine_rate_Hz;
    line += channel.samples[i] * std::polar(1.0, -turned_rad) / 1000.0;
  }
  return line;
}

}  // namespace rvbench::test
