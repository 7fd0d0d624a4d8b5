#include "sequences/phases/connect.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "hal/rig.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/interlock_check.hpp"

namespace rvbench::sequences {
namespace {

// Tries them all, so that one message names everything that does not answer.
std::optional<Ending> connect_all(hal::Rig& rig) {
  std::string silent;
  const auto note = [&silent](const Status& status) {
    if (!status) silent += (silent.empty() ? "" : "; ") + describe(status.error());
    return bool(status);
  };
  note(rig.safety->connect());
  note(rig.torque_sensor->connect());
  if (note(rig.accelerometers->connect())) note(rig.accelerometers->start());
  note(rig.brake->connect());
  note(rig.drive->connect());
  if (silent.empty()) return std::nullopt;
  return device_lost("not every device answers: " + silent);
}

class Connect final : public Phase {
 public:
  explicit Connect(double watchdog_max_s) : watchdog_max_s_(watchdog_max_s) {}

  std::string_view kind() const override { return "connect"; }

  std::string to_json() const override {
    return nlohmann::ordered_json{{"phase", kind()}, {"watchdog_max_s", watchdog_max_s_}}.dump();
  }

  std::vector<Segment> timeline(const Specimen&) const override { return {}; }

  std::optional<Ending> run(BenchLoop& loop, const Specimen&) override {
    if (auto ending = connect_all(loop.rig())) return ending;
    if (auto ending = refuse_to_arm(*loop.rig().drive)) return ending;
    return loop.arm();
  }

 private:
  std::optional<Ending> refuse_to_arm(hal::Drive& drive) const {
    const auto watchdog = drive.read_watchdog();
    if (!watchdog) return device_lost("the drive's watchdog: " + describe(watchdog.error()));
    const auto [timeout_s, stops_motor] = watchdog.value();
    if (!(timeout_s > 0)) {
      return device_lost("refused to arm: the drive's communication watchdog is off");
    }
    if (!stops_motor) {
      return device_lost(
          "refused to arm: the drive's communication watchdog does not stop the motor");
    }
    if (timeout_s > watchdog_max_s_) {
      return device_lost(
          fmt::format("refused to arm: the drive's watchdog waits {:g} s, at most {:g} s "
                      "is safe",
                      timeout_s, watchdog_max_s_));
    }
    return std::nullopt;
  }

  double watchdog_max_s_;
};

}  // namespace

std::unique_ptr<Phase> parse_connect(hal::ConfigReader& json) {
  return std::make_unique<Connect>(json.number("watchdog_max_s", {0.1, 2.0}, 2.0));
}

}  // namespace rvbench::sequences
