#pragma once

#include <string>
#include <utility>
#include <variant>

namespace rvbench {

/// Why a device call failed. Each of these is normal weather on a bench, so none is thrown.
enum class IoErrc {
  timeout,       ///< no reply before the deadline
  disconnected,  ///< the link is down, or was never up
  bad_reply,     ///< checksum, length, identity or value makes no sense
  refused,       ///< the device answered, and said no (tripped, local mode, watchdog off)
  stale,         ///< the device answers, but its value no longer moves on
  overrun,       ///< samples were lost
  bad_data       ///< of a file: damaged, of another shape, or of another kind
};

const char* to_string(IoErrc code) noexcept;

struct IoError {
  IoErrc code = IoErrc::disconnected;
  std::string where;  ///< device and operation: "inverter: read status (0x2101..0x2104)"
};

/// "inverter: read status: timeout"
std::string describe(const IoError& error);

/// A value, or the reason why there is none.
template <typename T>
class [[nodiscard]] Result {
 public:
  // Implicit on purpose, so that `return value;` and `return IoError{...};` both read naturally.
  Result(T value)  // NOLINT(google-explicit-constructor)
      : state_(std::in_place_index<0>, std::move(value)) {}
  Result(IoError error)  // NOLINT(google-explicit-constructor)
      : state_(std::in_place_index<1>, std::move(error)) {}

  explicit operator bool() const noexcept { return state_.index() == 0; }

  /// @throws std::bad_variant_access if there is an error instead
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  const IoError& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, IoError> state_;
};

struct Done {};
using Status = Result<Done>;

}  // namespace rvbench
