#include "bench/plug_test.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace rvbench::bench {
namespace {

constexpr double cycle_s = 0.05;

std::string fault_of(const hal::DriveStatus& status) {
  return status.tripped ? fmt::format(", fault code {}", status.fault_code) : "";
}

// One try of the test. Each step says why it ended the test, or nothing.
class Attempt {
 public:
  Attempt(hal::Drive& drive, hal::Clock& clock, const PlugTestOptions& options,
          const std::function<void(const std::string&)>& tell, const std::stop_token& stop)
      : drive_(drive), clock_(clock), options_(options), tell_(tell), stop_(stop) {}

  ~Attempt() { drive_.stop(); }
  Attempt(const Attempt&) = delete;
  Attempt& operator=(const Attempt&) = delete;

  PlugTest run() {
    tell_(fmt::format("the motor starts, {:g} rpm", options_.speed_rpm));
    if (auto why = run_up()) return {false, *why};
    tell_(fmt::format("pull the drive's communication cable now, within {:g} s",
                      options_.patience_s));
    if (auto why = wait_for_silence()) return {false, *why};
    tell_(fmt::format("the link is dead: watch the shaft, it must stop within {:g} s",
                      options_.silence_s));
    if (!pause(options_.silence_s)) return {false, "interrupted"};
    tell_(fmt::format("plug the cable in again, within {:g} s", options_.patience_s));
    return judge();
  }

 private:
  bool pause(double duration_s) {
    const double end_s = clock_.now_s() + duration_s;
    while (clock_.now_s() < end_s - 1e-6) {
      if (stop_.stop_requested()) return false;
      clock_.wait_until(std::min(end_s, clock_.now_s() + cycle_s));
    }
    return true;
  }

  std::optional<std::string> run_up() {
    const double end_s = clock_.now_s() + options_.patience_s;
    while (clock_.now_s() < end_s) {
      if (const Status set = drive_.set_speed(options_.speed_rpm); !set) {
        return describe(set.error());
      }
      if (!pause(cycle_s)) return "interrupted";
      const auto status = drive_.read();
      if (!status) return describe(status.error());
      if (std::abs(status.value().speed_rpm) > 0.8 * options_.speed_rpm) return std::nullopt;
    }
    return fmt::format("the motor did not reach {:g} rpm", options_.speed_rpm);
  }

  std::optional<std::string> wait_for_silence() {
    const double end_s = clock_.now_s() + options_.patience_s;
    while (clock_.now_s() < end_s) {
      const Status set = drive_.set_speed(options_.speed_rpm);
      const auto status = drive_.read();
      if (!set && !status) return std::nullopt;
      if (status && !status.value().running) {
        return "the motor stopped before the cable was pulled" + fault_of(status.value());
      }
      if (!pause(cycle_s)) return "interrupted";
    }
    return fmt::format("the cable was not pulled within {:g} s", options_.patience_s);
  }

  // The first thing that is asked over the new link: what the drive has done by itself.
  PlugTest judge() {
    const double end_s = clock_.now_s() + options_.patience_s;
    while (clock_.now_s() < end_s) {
      const auto status = drive_.read();
      if (status && status.value().running) {
        return {false, fmt::format("the motor still ran, {:g} rpm: nothing stops it when the link "
                                   "dies",
                                   status.value().speed_rpm)};
      }
      if (status) return {true, "it stopped by itself" + fault_of(status.value())};
      if (!pause(cycle_s)) return {false, "interrupted"};
    }
    return {false, fmt::format("the link did not come back within {:g} s", options_.patience_s)};
  }

  hal::Drive& drive_;
  hal::Clock& clock_;
  const PlugTestOptions& options_;
  const std::function<void(const std::string&)>& tell_;
  const std::stop_token& stop_;
};

}  // namespace

PlugTest pull_the_plug(hal::Drive& drive, hal::Clock& clock, const PlugTestOptions& options,
                       const std::function<void(const std::string&)>& tell,
                       const std::stop_token& stop) {
  return Attempt(drive, clock, options, tell, stop).run();
}

}  // namespace rvbench::bench
