#include "sequences/phases/connect.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hal/json_object.hpp"
#include "hal/rig.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/interlock_check.hpp"

namespace rvbench::sequences {
namespace {

using Answers = std::vector<Status>;

Status connect(hal::Accelerometers& accelerometers) {
  const Status connected = accelerometers.connect();
  return connected ? accelerometers.start() : connected;
}

// All of them, so that one message names everything that does not answer; in real time those on
// lines of their own at once, as each may take seconds to say that nobody is there. The bus comes
// last, with one caller at a time: nobody takes its frames until all is connected, and what has
// waited is as good as lost.
Answers connect_each(hal::Rig& rig) {
  const auto when = rig.clock->is_virtual() ? std::launch::deferred : std::launch::async;
  std::array lines{
      std::async(when, [&rig] { return rig.safety->connect(); }),
      std::async(when, [&rig] { return connect(*rig.accelerometers); }),
      std::async(when, [&rig] { return rig.drive->connect(); }),
  };
  Answers answers;
  for (auto& line : lines) answers.push_back(line.get());
  answers.push_back(rig.torque_sensor->connect());
  answers.push_back(rig.brake->connect());
  return answers;
}

std::optional<Ending> connect_all(hal::Rig& rig) {
  std::vector<std::string> silent;
  for (const Status& answer : connect_each(rig)) {
    if (answer) continue;
    const std::string why = describe(answer.error());
    if (std::ranges::find(silent, why) == silent.end()) silent.push_back(why);  // of one adapter
  }
  if (silent.empty()) return std::nullopt;
  return device_lost(fmt::format("not every device answers: {}", fmt::join(silent, "; ")));
}

class Connect final : public Phase {
 public:
  explicit Connect(double watchdog_max_s) : watchdog_max_s_(watchdog_max_s) {}

  std::string_view kind() const override { return "connect"; }

  std::string to_json() const override {
    return hal::json_object({{"phase", kind()}, {"watchdog_max_s", watchdog_max_s_}}).dump();
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
  return std::make_unique<Connect>(
      json.number("watchdog_max_s", {0.1, longest_watchdog_s}, longest_watchdog_s));
}

}  // namespace rvbench::sequences
