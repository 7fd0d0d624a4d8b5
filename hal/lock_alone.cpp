#include "hal/lock_alone.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <thread>

namespace rvbench::hal {
namespace {

constexpr std::chrono::milliseconds longest_look{100};  // of others, that do no more than look

}  // namespace

int lock_alone(int descriptor) noexcept {
  using namespace std::chrono;
  const auto end = steady_clock::now() + longest_look;
  for (;;) {
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return 0;
    if (errno != EWOULDBLOCK || steady_clock::now() > end) return errno;
    std::this_thread::sleep_for(milliseconds(1));
  }
}

// A shared lock: only who has the file alone keeps it from others that look.
std::optional<bool> is_locked(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0) return std::nullopt;
  const bool is_free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
  ::close(descriptor);
  return !is_free;
}

}  // namespace rvbench::hal
