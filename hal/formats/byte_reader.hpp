#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace rvbench::hal::formats {

/// The number whose bytes begin at `bytes`; it need not be aligned.
template <typename Number>
Number number_at(const char* bytes, std::endian order) {
  char copy[sizeof(Number)];
  std::memcpy(copy, bytes, sizeof(Number));
  if (order != std::endian::native) std::reverse(copy, copy + sizeof(Number));
  Number number;
  std::memcpy(&number, copy, sizeof(Number));
  return number;
}

/// Takes numbers off bytes, one after another. Beyond their end it gives zeros and is not ok.
class ByteReader {
 public:
  ByteReader(std::string_view bytes, std::endian order) : left_(bytes), order_(order) {}

  bool ok() const { return ok_; }
  std::string_view left() const { return left_; }

  std::string_view bytes(std::uint64_t count) {
    if (count > left_.size()) ok_ = false;
    if (!ok_) return {};
    const std::string_view taken = left_.substr(0, static_cast<std::size_t>(count));
    left_.remove_prefix(taken.size());
    return taken;
  }

  template <typename Number>
  Number number() {
    const std::string_view taken = bytes(sizeof(Number));
    return ok_ ? number_at<Number>(taken.data(), order_) : Number{};
  }

 private:
  std::string_view left_;
  std::endian order_;
  bool ok_ = true;
};

}  // namespace rvbench::hal::formats
