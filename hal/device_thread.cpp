#include "hal/device_thread.hpp"

#include <algorithm>
#include <exception>
#include <utility>

namespace rvbench::hal {

void DeviceThread::start(std::function<void(const std::stop_token&)> body) {
  stop();
  has_thrown_ = false;
  thread_ = std::jthread([this, body = std::move(body)](const std::stop_token& stop) {
    try {
      body(stop);
    } catch (const std::exception& error) {
      keep(error.what());
    } catch (...) {
      keep("an exception of no known kind");
    }
  });
}

void DeviceThread::stop() { thread_ = {}; }

std::string_view DeviceThread::thrown() const noexcept {
  return has_thrown_ ? std::string_view(what_.data()) : std::string_view();
}

void DeviceThread::keep(const char* what) noexcept {
  const std::string_view text(what);
  const std::size_t kept = std::min(text.size(), what_.size() - 1);
  std::ranges::copy(text.substr(0, kept), what_.begin());
  what_[kept] = '\0';
  has_thrown_ = true;
}

}  // namespace rvbench::hal
