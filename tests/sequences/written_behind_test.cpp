#include "sequences/written_behind.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

using namespace rvbench;
using sequences::ObserverBehind;
using sequences::Scribe;

namespace {

using Steady = std::chrono::steady_clock;

// A pipe that nobody reads, like a terminal after Ctrl-S: who writes waits once it is full.
class StoppedTerminal {
 public:
  StoppedTerminal() { REQUIRE(::pipe(ends_.data()) == 0); }
  ~StoppedTerminal() {
    for (const int end : ends_) ::close(end);
  }
  StoppedTerminal(const StoppedTerminal&) = delete;
  StoppedTerminal& operator=(const StoppedTerminal&) = delete;

  void write(const std::string& text) const { (void)!::write(ends_[1], text.data(), text.size()); }

  /// Reads, as after Ctrl-Q.
  void resume_until(const std::atomic<bool>& done) const {
    std::vector<char> taken(1U << 16U);
    pollfd end{ends_[0], POLLIN, 0};
    while (!done) {
      if (::poll(&end, 1, 10) > 0) (void)!::read(ends_[0], taken.data(), taken.size());
    }
  }

 private:
  std::array<int, 2> ends_{};
};

// Its screen, or its log, or both, are on that terminal.
class Teller final : public sequences::RunObserver {
 public:
  Teller(StoppedTerminal& terminal, bool shows, bool logs)
      : terminal_(terminal), shows_(shows), logs_(logs) {}
  void progress(double, double, const std::string& doing) override {
    if (shows_) terminal_.write(doing);
    has_shown = true;
  }
  void event(double, const std::string& text) override {
    if (logs_) terminal_.write(text);
    ++events;
    last = text;
    has_logged = true;
  }

  std::atomic<int> events = 0;
  std::string last;
  std::atomic<bool> has_shown = false, has_logged = false;

 private:
  StoppedTerminal& terminal_;
  bool shows_, logs_;
};

// A recording that throws what nobody knows.
class ThrowingRecording final : public hal::RecordingWriter {
 public:
  Status append(int, const hal::AccelerationBlock&) override { return Done{}; }
  Status append(int, const hal::TorqueBlock&) override { return Done{}; }
  Status end_point(const hal::PointResult&) override { throw 1; }
  Status note(double, const std::string&) override {
    ++notes;
    return Done{};
  }
  Status close() override { return Done{}; }

  int notes = 0;
};

double seconds_since(Steady::time_point start) {
  return std::chrono::duration<double>(Steady::now() - start).count();
}

const std::string more_than_a_pipe(1U << 20U, '.');

}  // namespace

TEST_CASE("a screen that hangs leaves the log alone, and is waited for a moment only",
          "[sequences][safety]") {
  StoppedTerminal terminal;
  Teller teller(terminal, true, false);
  {
    Scribe log(100'000), screen(100'000);
    ObserverBehind behind(teller, log, screen);
    behind.progress(1, 10, more_than_a_pipe);
    for (int i = 0; i < 100; ++i) {
      behind.progress(1, 10, "left out");
      behind.event(i, "event " + std::to_string(i));
    }
    const auto start = Steady::now();
    CHECK_FALSE(behind.finish());
    CHECK(seconds_since(start) < 4);
    CHECK(behind.untold() == 0);
    CHECK(teller.events == 100);
    CHECK(teller.last == "event 99");
    CHECK_FALSE(screen.post(0, [] {}));  // it was given up
  }
  terminal.resume_until(teller.has_shown);
}

TEST_CASE("a log that hangs takes no more than its share of memory, and it is said what is missing",
          "[sequences][safety]") {
  StoppedTerminal terminal;
  Teller teller(terminal, false, true);
  Scribe log(2'000'000), screen(1000);
  ObserverBehind behind(teller, log, screen);
  behind.event(0, more_than_a_pipe);
  for (int i = 0; i < 10'000; ++i) behind.event(i, std::string(1000, '-'));
  CHECK(behind.untold() > 9'000);  // of a line of 1.5 kB there is room for some six hundred
  CHECK(behind.untold() < 9'500);
  SECTION("once it goes on") {
    const std::size_t untold = behind.untold();
    std::atomic<bool> is_over = false;
    std::jthread reader([&] { terminal.resume_until(is_over); });
    log.finish();
    behind.event(1, "the last");
    const bool is_finished = behind.finish();
    is_over = true;
    REQUIRE(is_finished);
    CHECK(behind.untold() == 0);
    CHECK(teller.events == 10'001 - int(untold) + 2);  // and how many were left out, and the last
    CHECK(teller.last == "the last");
  }
  SECTION("and at the end") {
    const auto start = Steady::now();
    CHECK_FALSE(behind.finish());
    CHECK(seconds_since(start) < 4);
    CHECK(behind.untold() == 10'001);
    terminal.resume_until(teller.has_logged);
  }
}

TEST_CASE("a recording that throws is no whole one", "[sequences]") {
  ThrowingRecording recording;
  Scribe disk(1'000'000);
  sequences::RecordingBehind behind(recording, disk);
  (void)behind.end_point({});
  (void)behind.note(1, "after the hole");
  const Status settled = behind.settle();
  REQUIRE_FALSE(settled);
  CHECK_THAT(settled.error().where, Catch::Contains("a part was not written"));
  CHECK_FALSE(behind.note(2, "later"));
  CHECK(recording.notes == 0);
}
