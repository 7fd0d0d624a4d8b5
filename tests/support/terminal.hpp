#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <string>

namespace rvbench::test {

/// A terminal of its own, which can be stopped as Ctrl-S does: who writes then, waits.
class Terminal {
 public:
  Terminal() : screen_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    REQUIRE((screen_ >= 0 && ::grantpt(screen_) == 0 && ::unlockpt(screen_) == 0));
    name_ = ::ptsname(screen_);
    descriptor_ = ::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE(descriptor_ >= 0);
  }
  ~Terminal() {
    ::tcflow(descriptor_, TCOON);
    ::close(descriptor_);
    ::close(screen_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  const std::string& name() const { return name_; }  ///< "/dev/pts/7"
  int descriptor() const { return descriptor_; }

  /// As on its keyboard.
  void type(const std::string& keys) const {
    REQUIRE(::write(screen_, keys.data(), keys.size()) == ssize_t(keys.size()));
  }

  /// Who reads from it meets the end at once, as of an empty file.
  void give_nothing() const {
    termios how{};
    REQUIRE(::tcgetattr(descriptor_, &how) == 0);
    how.c_lflag &= ~tcflag_t{ICANON | ECHO};
    how.c_cc[VMIN] = how.c_cc[VTIME] = 0;
    REQUIRE(::tcsetattr(descriptor_, TCSANOW, &how) == 0);
  }
  void stop() const { REQUIRE(::tcflow(descriptor_, TCOOFF) == 0); }
  void go_on() const { REQUIRE(::tcflow(descriptor_, TCOON) == 0); }

  /// What has been shown since it was asked last; waits until there is something.
  std::string shown() const {
    std::array<char, 4096> bytes{};
    pollfd screen{screen_, POLLIN, 0};
    REQUIRE(::poll(&screen, 1, 60'000) == 1);
    const auto count = ::read(screen_, bytes.data(), bytes.size());
    REQUIRE(count > 0);
    return {bytes.data(), static_cast<std::size_t>(count)};
  }

 private:
  int screen_;
  int descriptor_ = -1;
  std::string name_;
};

}  // namespace rvbench::test
