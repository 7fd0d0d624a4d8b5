#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <stop_token>
#include <string_view>
#include <thread>

namespace rvbench::hal {

/// The thread in which a driver listens to its device.
///
/// Nothing that is thrown in it leaves it: that would end the process while the shaft turns. It is
/// kept instead, and whoever reads the device tells it, as of any device that is lost.
///
/// Threads  thrown() from any, the others from one
class DeviceThread {
 public:
  /// Ends an earlier one first.
  /// @param body  returns when it is asked to stop
  void start(std::function<void(const std::stop_token&)> body);
  void request_stop() { thread_.request_stop(); }
  void stop();  ///< and waits for its end

  bool is_started() const { return thread_.joinable(); }
  /// What ended it: "std::bad_alloc"; empty while nothing has. Legal until the next start().
  std::string_view thrown() const noexcept;

 private:
  void keep(const char* what) noexcept;

  std::array<char, 128> what_{};  ///< there may be no memory left for a longer one
  std::atomic<bool> has_thrown_ = false;
  std::jthread thread_;
};

}  // namespace rvbench::hal
