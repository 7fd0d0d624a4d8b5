#include "sim/anti_alias_filter.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>

namespace rvbench::sim {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double stop_share = 0.6;  // of the ADC's rate: where the stop band begins
constexpr double stop_gain = 1e-3;

}  // namespace

AntiAliasFilter::AntiAliasFilter(double rate_Hz, double sampling_Hz) {
  const double stop_Hz = stop_share * sampling_Hz;
  if (!(stop_Hz > 0 && stop_Hz < rate_Hz / 2)) {
    throw std::invalid_argument(fmt::format(
        "AntiAliasFilter: stop band from {} Hz, must be within (0, {})", stop_Hz, rate_Hz / 2));
  }
  const double stop = std::tan(pi * stop_Hz / rate_Hz);
  const double spread = std::asinh(std::sqrt(1 / (stop_gain * stop_gain) - 1)) / order;
  for (int i = 0; i < order / 2; ++i) {
    const double angle = pi * (2 * i + 1) / (2 * order);
    const std::complex<double> pole =
        stop / std::complex<double>(-std::sinh(spread) * std::sin(angle),
                                    std::cosh(spread) * std::cos(angle));
    const double zero2 = std::pow(stop / std::cos(angle), 2);  // both squared, on the axis of s
    const double pole2 = std::norm(pole);
    const double a0 = 1 - 2 * pole.real() + pole2;
    const double gain = pole2 / zero2 / a0;
    sections_[static_cast<std::size_t>(i)] = {.b0 = gain * (zero2 + 1),
                                              .b1 = gain * 2 * (zero2 - 1),
                                              .a1 = 2 * (pole2 - 1) / a0,
                                              .a2 = (1 + 2 * pole.real() + pole2) / a0};
  }
}

double AntiAliasFilter::step(double value) {
  for (Section& s : sections_) {
    const double out = s.b0 * value + s.first;
    s.first = s.b1 * value - s.a1 * out + s.second;
    s.second = s.b0 * value - s.a2 * out;
    value = out;
  }
  return value;
}

}  // namespace rvbench::sim
