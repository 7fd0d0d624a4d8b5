#include "bench/serve/other_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <utility>

#include "bench/text_file.hpp"
#include "hal/lock_alone.hpp"

namespace rvbench::bench {
namespace {

constexpr std::chrono::milliseconds between_looks{100};  // at whether somebody said stop

struct Descriptor {
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

// Nothing of this process is left to the other but these descriptors, as its 0, 1, 2, ...
// @return errno, or 0
int spawn(pid_t& process, const std::vector<std::string>& words, const std::vector<int>& kept,
          bool in_own_session) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  int as = 0;
  for (const int descriptor : kept) posix_spawn_file_actions_adddup2(&actions, descriptor, as++);
  posix_spawn_file_actions_addclosefrom_np(&actions, as);
  sigset_t all, none;
  sigfillset(&all);
  sigemptyset(&none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setsigmask(&attributes, &none);
  const int session = in_own_session ? POSIX_SPAWN_SETSID : 0;
  posix_spawnattr_setflags(
      &attributes, static_cast<short>(POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK | session));
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const int error =
      posix_spawn(&process, argv.front(), &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  return error;
}

int open_process(pid_t process) { return static_cast<int>(::syscall(SYS_pidfd_open, process, 0)); }

std::string text_in(int descriptor) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (off_t at = 0;;) {
    const ssize_t got = ::pread(descriptor, buffer.data(), buffer.size(), at);
    if (got <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(got));
    at += got;
  }
}

// Within that time, and before a stop.
bool has_ended(int process, double longest_s, const std::stop_token& stop) {
  using namespace std::chrono;
  const auto until =
      steady_clock::now() + duration_cast<steady_clock::duration>(duration<double>(longest_s));
  while (!stop.stop_requested()) {
    const auto left = duration_cast<milliseconds>(until - steady_clock::now());
    if (left.count() <= 0) return false;
    pollfd ended{process, POLLIN, 0};
    if (::poll(&ended, 1, static_cast<int>(std::min(left, between_looks).count())) > 0) return true;
  }
  return false;
}

int code_of(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1; }

}  // namespace

ProgramAnswer ask_program(const std::vector<std::string>& words, double longest_s,
                          const std::stop_token& stop) {
  // Far from the numbers that they are copied to.
  const Descriptor nothing(::open("/dev/null", O_RDWR | O_CLOEXEC));
  const Descriptor out(::memfd_create("out", MFD_CLOEXEC));
  const Descriptor err(::memfd_create("err", MFD_CLOEXEC));
  ProgramAnswer answer;
  pid_t process = -1;
  if (const int error = spawn(process, words, {nothing.number, out.number, err.number}, false)) {
    answer.err = std::strerror(error);
    return answer;
  }
  const Descriptor watched(open_process(process));
  const bool in_time = has_ended(watched.number, longest_s, stop);
  if (!in_time) ::kill(process, SIGKILL);
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  answer.code = in_time ? code_of(status) : -1;
  answer.out = text_in(out.number);
  answer.err = in_time ? text_in(err.number) : "it took too long";
  return answer;
}

std::string RunProcess::start(const std::vector<std::string>& words) {
  const Descriptor lock(::open(lock_file().c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
  if (lock.number < 0) return lock_file().string() + ": " + std::strerror(errno);
  if (const int error = hal::lock_alone(lock.number)) {
    return error == EWOULDBLOCK ? "a run is at work already" : std::strerror(error);
  }
  const auto create = [](const std::filesystem::path& file) {
    return ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0640);
  };
  const Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
  const Descriptor out(create(answer_file())), err(create(log_file()));
  if (nothing.number < 0 || out.number < 0 || err.number < 0) {
    return folder_.string() + ": " + std::strerror(errno);
  }
  const int error =
      spawn(child_, words, {nothing.number, out.number, err.number, lock.number}, true);
  if (error != 0) return words.front() + ": " + std::strerror(error);
  const std::string number = std::to_string(child_) + "\n";
  // Where the disk does not take its number, no later station can stop it: it runs all the same.
  if (::ftruncate(lock.number, 0) == 0) {
    [[maybe_unused]] const auto written = ::pwrite(lock.number, number.data(), number.size(), 0);
  }
  return "";
}

bool RunProcess::is_alive() {
  int status = 0;
  if (child_ > 0 && ::waitpid(child_, &status, WNOHANG) == child_) child_ = -1;
  return child_ > 0 || hal::is_locked(lock_file()).value_or(false);
}

bool RunProcess::stop() {
  pid_t process = child_;
  if (process <= 0) {  // of another station
    const std::string text = read_file(lock_file()).value_or("");
    std::from_chars(text.data(), text.data() + text.size(), process);
  }
  if (process <= 0) return false;
  const Descriptor target(open_process(process));
  // Asked once the process is held: its number may have become somebody else's before.
  if (target.number < 0 || !is_alive()) return false;
  return ::syscall(SYS_pidfd_send_signal, target.number, SIGTERM, nullptr, 0) == 0;
}

}  // namespace rvbench::bench
