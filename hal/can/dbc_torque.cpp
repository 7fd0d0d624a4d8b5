#include "hal/can/dbc_torque.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "hal/did_you_mean.hpp"

namespace rvbench::hal {
namespace {

// What one of a unit is worth.
const std::map<std::string, double, std::less<>>& torque_units_Nm() {
  static const std::map<std::string, double, std::less<>> units{
      {"Nm", 1},     {"N·m", 1},     {"N.m", 1},   {"N*m", 1},
      {"mNm", 1e-3}, {"mN·m", 1e-3}, {"kNm", 1e3}, {"kN·m", 1e3}};
  return units;
}

const std::map<std::string, double, std::less<>>& angle_units_turns() {
  static const std::map<std::string, double, std::less<>> units{
      {"deg", 1.0 / 360}, {"°", 1.0 / 360}, {"rad", 0.15915494309189535}, {"rev", 1}, {"turn", 1}};
  return units;
}

class Finder {
 public:
  explicit Finder(const dbc::Message& message) : message_(message) {}

  const dbc::Signal* signal(const std::string& key, const std::string& name) {
    const dbc::Signal* const found = message_.find(name);
    if (found == nullptr) {
      std::vector<std::string> names;
      for (const dbc::Signal& one : message_.signals) names.push_back(one.name);
      faults.push_back(
          {0, "/" + key,
           message_.name + " has no signal " + in_quotes(name) + did_you_mean(name, names)});
    } else if (found->is_float) {
      faults.push_back({0, "/" + key, name + " is a floating-point number, expected an integer"});
    }
    return found;
  }

  double worth(const std::string& key, const dbc::Signal* signal,
               const std::map<std::string, double, std::less<>>& units) {
    if (signal == nullptr) return 0;
    const auto found = units.find(signal->unit);
    if (found != units.end()) return found->second;
    std::string known;
    for (const auto& [unit, value] : units) known += (known.empty() ? "" : ", ") + unit;
    faults.push_back(
        {0, "/" + key, signal->name + " is in " + in_quotes(signal->unit) + ", expected " + known});
    return 0;
  }

  std::vector<ConfigFault> faults;

 private:
  const dbc::Message& message_;
};

}  // namespace

std::variant<TorqueDecoder, std::vector<ConfigFault>> torque_decoder(const dbc::Database& database,
                                                                     const DbcTorqueNames& names) {
  const dbc::Message* const message = database.find(names.message);
  if (message == nullptr) {
    std::vector<std::string> known;
    for (const dbc::Message& one : database.messages) known.push_back(one.name);
    return std::vector<ConfigFault>{
        {0, "/message",
         "no message " + in_quotes(names.message) + did_you_mean(names.message, known)}};
  }
  Finder finder(*message);
  if (message->is_extended) {
    finder.faults.push_back({0, "/message", message->name + " has 29 bits of identifier, not 11"});
  }
  const dbc::Signal* const torque = finder.signal("torque", names.torque);
  const dbc::Signal* const angle = finder.signal("angle", names.angle);
  const dbc::Signal* const counter = finder.signal("counter", names.counter);
  const dbc::Signal* const status =
      names.status.empty() ? nullptr : finder.signal("status", names.status);
  const double torque_Nm = finder.worth("torque", torque, torque_units_Nm());
  const double angle_turns = finder.worth("angle", angle, angle_units_turns());
  if (counter != nullptr && counter->length < 8) {
    finder.faults.push_back({0, "/counter", counter->name + " has fewer than 8 bits"});
  }
  if (!finder.faults.empty()) return finder.faults;
  // By value: the database may be gone when frames come.
  return TorqueDecoder(
      [message = *message, torque = *torque, angle = *angle, counter = *counter,
       status = status ? std::optional(*status) : std::nullopt, torque_Nm,
       angle_turns](const CanFrame& frame) -> std::optional<can_frames::TorqueFrame> {
        const auto value = [&](const dbc::Signal& of) { return dbc::value_of(message, of, frame); };
        const auto torque_told = value(torque), angle_told = value(angle), counted = value(counter);
        if (!torque_told || !angle_told || !counted) return std::nullopt;
        const auto state = status ? value(*status) : 0;
        if (!state) return std::nullopt;
        const bool is_sound = *state == 0;
        const double turns = *angle_told * angle_turns;
        return can_frames::TorqueFrame{
            .torque_Nm = *torque_told * torque_Nm,
            .angle_turns = turns - std::floor(turns),
            .counter = static_cast<std::uint8_t>(std::llround(std::fmod(*counted, 256))),
            .flaw = is_sound ? "" : status->name + ": " + dbc::word_for(*status, *state)};
      });
}

}  // namespace rvbench::hal
