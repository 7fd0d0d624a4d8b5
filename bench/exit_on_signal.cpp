#include "bench/exit_on_signal.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "bench/command.hpp"

namespace rvbench::bench {
namespace {

// Only what is async-signal-safe.
extern "C" void end_interrupted(int) {
  constexpr std::string_view line = "rvbench: interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, line.data(), line.size());
  _exit(exit_codes::aborted);
}

}  // namespace

void exit_on_signal() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = end_interrupted;
    sigfillset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

}  // namespace rvbench::bench
