#include "bench/stop_on_signal.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <system_error>

namespace rvbench::bench {
namespace {

// request_stop() may run callbacks and is not async-signal-safe; the handler only writes a number
// to an eventfd, and a thread of its own does the rest.
constexpr std::uint64_t signalled = 1;
constexpr std::uint64_t farewell = 1ULL << 32U;
std::atomic<int> wake_fd{-1};

void write_number(std::uint64_t number) {
  const int saved_errno = errno;
  [[maybe_unused]] const auto written = write(wake_fd.load(), &number, sizeof number);
  errno = saved_errno;
}

extern "C" void on_stop_signal(int) { write_number(signalled); }

void watch(std::stop_source source) {
  std::uint64_t number = 0;
  while (number < farewell) {
    const auto got = read(wake_fd.load(), &number, sizeof number);
    if (got != sizeof number && errno != EINTR) return;
    if (got == sizeof number && number % farewell != 0) source.request_stop();
  }
}

}  // namespace

StopOnSignal::StopOnSignal() {
  wake_fd = eventfd(0, EFD_CLOEXEC);
  if (wake_fd < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
  watcher_ = std::thread(watch, source_);
  struct sigaction action {};
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signals.size(); ++i) {
    sigaction(signals[i], nullptr, &previous_[i]);
    const bool nohup = signals[i] == SIGHUP && previous_[i].sa_handler == SIG_IGN;
    const bool is_error_of_write = signals[i] == SIGPIPE || signals[i] == SIGXFSZ;
    action.sa_handler = is_error_of_write || nohup ? SIG_IGN : on_stop_signal;
    sigaction(signals[i], &action, nullptr);
  }
}

StopOnSignal::~StopOnSignal() {
  for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &previous_[i], nullptr);
  write_number(farewell);
  watcher_.join();
  close(wake_fd.exchange(-1));
}

}  // namespace rvbench::bench
