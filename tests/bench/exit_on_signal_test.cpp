#include "bench/exit_on_signal.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <csignal>
#include <string>

namespace rvbench::bench {
namespace {

constexpr int outlived = 7;

struct End {
  int status = 0;
  std::string said;
};

// A process that is sent a signal as soon as it has asked for it.
End after(int signal, bool is_ignored) {
  std::array<int, 2> err{};
  REQUIRE(pipe(err.data()) == 0);
  const pid_t process = fork();
  REQUIRE(process >= 0);
  if (process == 0) {
    dup2(err[1], STDERR_FILENO);
    std::signal(signal, is_ignored ? SIG_IGN : SIG_DFL);
    exit_on_signal();
    raise(signal);
    _exit(outlived);
  }
  close(err[1]);
  End end;
  char c = 0;
  while (read(err[0], &c, 1) == 1) end.said += c;
  close(err[0]);
  REQUIRE(waitpid(process, &end.status, 0) == process);
  return end;
}

}  // namespace

TEST_CASE("a signal before there is any work ends with the exit code of an interrupt, and one line",
          "[bench]") {
  const int signal = GENERATE(SIGINT, SIGTERM, SIGHUP);
  const End end = after(signal, false);
  REQUIRE(WIFEXITED(end.status));
  CHECK(WEXITSTATUS(end.status) == 50);
  CHECK(end.said == "rvbench: interrupted\n");
}

TEST_CASE("a signal that the caller ignores stays ignored", "[bench]") {
  const End end = after(SIGHUP, true);
  REQUIRE(WIFEXITED(end.status));
  CHECK(WEXITSTATUS(end.status) == outlived);
  CHECK(end.said.empty());
}

}  // namespace rvbench::bench
