#pragma once

#include <string>
#include <vector>

#include "tests/hal/foreign_file_builder.hpp"

/// TDMS files, written from their description, apart from the code that reads them.
namespace rvbench::test {

struct Tdms {
  std::endian order = std::endian::little;

  template <typename Number>
  std::string number(Number value) const {
    return packed(value, order);
  }
  std::string text(const std::string& value) const {
    return number(static_cast<std::uint32_t>(value.size())) + value;
  }
  template <typename Number>
  std::string numbers(const std::vector<Number>& values) const {
    std::string bytes;
    for (const Number value : values) bytes += number(value);
    return bytes;
  }

  std::string property(const std::string& name, const std::string& value) const {
    return text(name) + number(0x20U) + text(value);
  }
  std::string property(const std::string& name, double value) const {
    return text(name) + number(10U) + number(value);
  }
  std::string property(const std::string& name, std::int32_t value) const {
    return text(name) + number(3U) + number(value);
  }

  /// @param type  2 int16, 3 int32, 9 float, 10 double ...
  std::string index(std::uint32_t type, std::uint64_t count) const {
    return number(20U) + number(type) + number(1U) + number(count);
  }
  std::string text_index(std::uint64_t count, std::uint64_t bytes) const {
    return number(28U) + number(0x20U) + number(1U) + number(count) + number(bytes);
  }
  std::string no_index() const { return number(0xFFFFFFFFU); }
  std::string same_index() const { return number(0U); }

  /// One scaler in one buffer. @param type  3 int16, 5 int32
  std::string daqmx_index(std::uint64_t count, std::uint32_t type, std::uint32_t offset,
                          std::uint32_t row_bytes, bool is_digital = false) const {
    return number(is_digital ? 0x126AU : 0x1269U) + number(0xFFFFFFFFU) + number(1U) +
           number(count) + number(1U) + number(type) + number(0U) + number(offset) +
           (is_digital ? number(std::uint8_t{0}) : number(0U)) + number(0U) + number(1U) +
           number(row_bytes);
  }

  /// One scaler, at the begin of the rows of one of several buffers.
  std::string daqmx_buffer_index(std::uint64_t count, std::uint32_t type, std::uint32_t buffer,
                                 const std::vector<std::uint32_t>& row_bytes) const {
    return number(0x1269U) + number(0xFFFFFFFFU) + number(1U) + number(count) + number(1U) +
           number(type) + number(buffer) + number(0U) + number(0U) + number(0U) +
           number(static_cast<std::uint32_t>(row_bytes.size())) + numbers(row_bytes);
  }

  std::string object(const std::string& path, const std::string& index,
                     const std::vector<std::string>& properties = {}) const {
    std::string bytes = text(path) + index + number(static_cast<std::uint32_t>(properties.size()));
    for (const std::string& property : properties) bytes += property;
    return bytes;
  }

  /// @param flags  besides metadata (2), new list (4), raw data (8): 0x20 interleaved, 0x80 DAQmx
  std::string segment(const std::vector<std::string>& objects, const std::string& raw,
                      std::uint32_t flags = 2 | 4 | 8, std::int64_t declared = -1) const {
    std::string meta;
    if ((flags & 2U) != 0) {
      meta = number(static_cast<std::uint32_t>(objects.size()));
      for (const std::string& object : objects) meta += object;
    }
    if (order == std::endian::big) flags |= 0x40U;
    const std::uint64_t length =
        declared == -1 ? meta.size() + raw.size() : static_cast<std::uint64_t>(declared);
    return "TDSm" + packed(flags) + number(4713U) + number(length) +
           number(static_cast<std::uint64_t>(meta.size())) + meta + raw;
  }
};

}  // namespace rvbench::test
