#pragma once

#include <stdexcept>
#include <string>

namespace rvbench {

/// What a caller must keep to, told in the name of whoever asks it:
///
///     constexpr Require require{"SlcanTransport"};
///     require(!device.empty(), "no device");
class Require {
 public:
  /// @param where  must outlive it
  explicit constexpr Require(const char* where) : where_(where) {}

  /// @throws std::invalid_argument "SlcanTransport: no device"
  void operator()(bool holds, const std::string& what) const {
    if (!holds) throw std::invalid_argument(std::string(where_) + ": " + what);
  }

 private:
  const char* where_;
};

}  // namespace rvbench
