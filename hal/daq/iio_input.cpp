#include "hal/daq/iio_input.hpp"

#include <fmt/format.h>
#include <iio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <system_error>

#include "hal/did_you_mean.hpp"

namespace rvbench::hal {
namespace {

IoError failure(const iio_channel* channel, IoErrc code, const std::string& why) {
  return {code, fmt::format("{}: {}", iio_channel_get_id(channel), why)};
}

// An attribute that a channel need not have. One that it has and does not tell is no default: every
// value of the channel would be wrong, and nobody would see it.
Result<double> attribute_or(const iio_channel* channel, const char* name, double without) {
  if (iio_channel_find_attr(channel, name) == nullptr) return without;
  std::array<char, 128> text{};
  const ssize_t length = iio_channel_attr_read(channel, name, text.data(), text.size() - 1);
  if (length < 0) {
    return failure(channel, IoErrc::refused, fmt::format("{}: {}", name, iio_reason(length)));
  }
  std::string_view told = text.data();
  while (told.ends_with('\n') || told.ends_with(' ')) told.remove_suffix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(told.data(), told.data() + told.size(), value);
  const bool is_number = error == std::errc() && end == told.data() + told.size();
  if (is_number && std::isfinite(value)) return value;
  return failure(channel, IoErrc::bad_reply,
                 fmt::format("{}: expected a number, found {}", name, in_quotes(told)));
}

// m/s² per unit of the scaled value, which is a millivolt, or m/s² where the device knows its
// sensors. Source: Linux' Documentation/ABI/testing/sysfs-bus-iio, in_voltageY_raw and
// in_accel_x_raw.
Result<double> m_s2_per_unit(const iio_channel* channel, double sensitivity) {
  const bool is_voltage = iio_channel_get_type(channel) == IIO_VOLTAGE;
  const bool is_known = std::isfinite(sensitivity);
  if (is_voltage && !is_known) {
    return failure(channel, IoErrc::refused, "it tells volts, and the sensor has no sensitivity");
  }
  if (!is_voltage && is_known) {
    return failure(channel, IoErrc::refused, "it tells m/s², and needs no sensitivity");
  }
  return is_known ? 1e-3 / sensitivity : 1;
}

double count_of(const iio_channel* channel, const void* sample) {
  const iio_data_format* format = iio_channel_get_data_format(channel);
  std::array<std::byte, 8> host{};
  iio_channel_convert(channel, host.data(), sample);
  const auto as = [&host](auto zero) {
    std::copy_n(host.data(), sizeof zero, reinterpret_cast<std::byte*>(&zero));
    return double(zero);
  };
  switch (format->length) {
    case 8: return format->is_signed ? as(std::int8_t{}) : as(std::uint8_t{});
    case 16: return format->is_signed ? as(std::int16_t{}) : as(std::uint16_t{});
    case 32: return format->is_signed ? as(std::int32_t{}) : as(std::uint32_t{});
    default: return format->is_signed ? as(std::int64_t{}) : as(std::uint64_t{});
  }
}

}  // namespace

Result<IioInput> read_iio_input(iio_channel* channel, double sensitivity) {
  const auto unit = m_s2_per_unit(channel, sensitivity);
  if (!unit) return unit.error();
  const auto scale = attribute_or(channel, "scale", 1);
  if (!scale) return scale.error();
  const auto offset = attribute_or(channel, "offset", 0);
  if (!offset) return offset.error();
  return IioInput{channel, scale.value() * unit.value(), offset.value()};
}

double IioInput::m_s2_of(const void* sample) const {
  return (count_of(channel, sample) + offset_counts) * m_s2_per_count;
}

double IioInput::full_scale_m_s2() const {
  const iio_data_format* format = iio_channel_get_data_format(channel);
  const double span = std::exp2(double(format->bits));
  const double lowest = offset_counts - (format->is_signed ? span / 2 : 0);
  const double highest = lowest + span - 1;
  const bool is_two_sided = lowest < 0 && highest > 0;
  const double counts =
      is_two_sided ? std::min(-lowest, highest) : std::max(std::abs(lowest), std::abs(highest));
  return counts * std::abs(m_s2_per_count);
}

std::string iio_reason(ssize_t error) {
  std::array<char, 128> text{};
  iio_strerror(int(std::abs(error)), text.data(), text.size());
  return text.data();
}

}  // namespace rvbench::hal
