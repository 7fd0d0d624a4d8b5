#include "bench/roll_call.hpp"

#include <algorithm>
#include <array>
#include <future>
#include <string>
#include <vector>

#include "hal/types/result.hpp"

namespace rvbench::bench {
namespace {

using Answers = std::vector<Status>;

// Both are on one bus, which has one caller at a time.
Answers call_bus(hal::Rig& rig) {
  Answers answers;
  answers.push_back(rig.torque_sensor->connect());
  answers.push_back(rig.brake->connect());
  return answers;
}

}  // namespace

std::optional<Ending> roll_call(hal::Rig& rig) {
  std::array calls{
      std::async(std::launch::async, [&rig] { return Answers{rig.safety->connect()}; }),
      std::async(std::launch::async, [&rig] { return call_bus(rig); }),
      std::async(std::launch::async, [&rig] { return Answers{rig.accelerometers->connect()}; }),
      std::async(std::launch::async, [&rig] { return Answers{rig.drive->connect()}; })};
  std::vector<std::string> absent;
  for (auto& call : calls) {
    for (const Status& answer : call.get()) {
      const std::string why = answer ? "" : describe(answer.error());
      const bool is_told = std::ranges::find(absent, why) != absent.end();  // of one adapter
      if (!answer && !is_told) absent.push_back(why);
    }
  }
  if (absent.empty()) return std::nullopt;
  rig.drive->stop();
  rig.brake->release();
  rig.accelerometers->stop();
  std::string all;
  for (const std::string& why : absent) all += (all.empty() ? "" : "; ") + why;
  return Ending{Outcome::error, ErrorKind::device_lost, "not every device answers: " + all};
}

}  // namespace rvbench::bench
