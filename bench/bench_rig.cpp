#include "bench/bench_rig.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "hal/can/can_dispatcher.hpp"
#include "hal/can/can_frames.hpp"
#include "hal/json_object.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

template <typename Section>
std::optional<Section> read_optional(hal::ConfigReader& root, const char* key,
                                     Section (*read)(hal::ConfigReader&)) {
  auto section = root.optional_object(key);
  return section ? std::optional(read(*section)) : std::nullopt;
}

// The serial line of a device; "" if it has none.
std::string line_of(const hal::ModbusPath& path) {
  const auto* rtu = std::get_if<hal::ModbusRtu>(&path);
  return rtu == nullptr ? "" : rtu->device;
}

std::string line_of(const CanSection& can) {
  const auto* slcan = std::get_if<hal::SlcanOptions>(&can.bus);
  return slcan == nullptr ? "" : slcan->device;
}

bool is_one_device(const DriveSection& drive, const SafetySection& safety) {
  const auto* a = std::get_if<hal::ModbusTcp>(&drive.options.path);
  const auto* b = std::get_if<hal::ModbusTcp>(&safety.options.path);
  return a != nullptr && b != nullptr && a->host == b->host && a->port == b->port &&
         drive.options.unit_id == safety.options.unit_id;
}

// Each would read what the others are answered. One address of TCP may be a gateway to several.
void note_shared_lines(hal::ConfigReader& root, const BenchRig& rig) {
  std::map<std::string, std::string> sections{{line_of(rig.drive.options.path), "drive"}};
  const auto note = [&](const std::string& line, const char* section) {
    const auto [other, is_first] = sections.emplace(line, section);
    if (is_first || line.empty()) return;
    root.fault(section, line + " is the serial line of \"" + other->second + "\", too");
  };
  if (rig.can) note(line_of(*rig.can), "can");
  if (rig.safety) note(line_of(rig.safety->options.path), "safety");
}

}  // namespace

BenchRig read_bench_rig(hal::ConfigReader& root) {
  BenchRig rig;
  rig.drive = read_drive_section(root);
  rig.can = read_optional(root, "can", read_can_section);
  rig.torque = read_optional(root, "torque", read_torque_section);
  rig.brake = read_optional(root, "brake", read_brake_section);
  rig.accelerometers = read_optional(root, "accelerometers", read_accelerometer_section);
  rig.safety = read_optional(root, "safety", read_safety_section);
  rig.plant = root.text("plant", rig.plant);
  rig.qualification = read_qualification_section(root, "bench", channels_of(rig));
  for (const auto& [has, key] :
       {std::pair{rig.torque.has_value(), "torque"}, {rig.brake.has_value(), "brake"}}) {
    if (has && !rig.can) root.fault(key, "it is on a CAN bus, and the file has no \"can\"");
  }
  const bool own_id = !rig.torque || !unfit_for_runs(*rig.torque).empty() ||
                      frame_id(*rig.torque) != hal::can_frames::brake_status_id;
  note_shared_lines(root, rig);
  if (rig.safety && is_one_device(rig.drive, *rig.safety)) {
    root.fault("safety", "it has the address and the unit of \"drive\"");
  }
  if (rig.brake && !own_id) root.fault("torque", "its frames have the identifier of the brake's");
  return rig;
}

nlohmann::ordered_json to_json(const BenchRig& rig) {
  nlohmann::ordered_json json = hal::json_object({{"rig", "bench"}, {"drive", to_json(rig.drive)}});
  if (rig.can) json["can"] = to_json(*rig.can);
  if (rig.torque) json["torque"] = to_json(*rig.torque);
  if (rig.brake) json["brake"] = to_json(*rig.brake);
  if (rig.accelerometers) json["accelerometers"] = to_json(*rig.accelerometers);
  if (rig.safety) json["safety"] = to_json(*rig.safety);
  json["plant"] = rig.plant;
  if (rig.qualification) json["qualification"] = to_json(*rig.qualification);
  return json;
}

std::vector<ChannelInfo> channels_of(const BenchRig& rig) {
  std::vector<ChannelInfo> channels;
  if (rig.accelerometers) {
    const auto& inputs = std::visit(
        [](const auto& options) -> const auto& { return options.inputs; },
        rig.accelerometers->options);
    for (const hal::DaqInput& input : inputs) channels.push_back(input.info);
  }
  if (rig.torque)
    channels.push_back({std::string(channel_names::input_torque), "N·m", "", not_known});
  return channels;
}

std::vector<hal::ConfigFault> unfit_for_runs(const BenchRig& rig) {
  std::vector<hal::ConfigFault> faults;
  const auto need = [&](bool has, const std::string& key) {
    if (has) return;
    faults.push_back(
        {0, "/" + key, "this section is missing: a run needs it, rvbench probe does not"});
  };
  need(rig.can.has_value(), "can");
  need(rig.torque.has_value(), "torque");
  need(rig.brake.has_value(), "brake");
  need(rig.accelerometers.has_value(), "accelerometers");
  need(rig.safety.has_value(), "safety");
  const std::string why = rig.torque ? unfit_for_runs(*rig.torque) : "";
  if (!why.empty()) faults.push_back({0, "/torque/frames", why});
  return faults;
}

std::variant<hal::Rig, std::vector<hal::ConfigFault>> make_bench(const BenchRig& rig) {
  if (auto faults = unfit_for_runs(rig); !faults.empty()) return faults;
  hal::Rig made;
  made.name = "bench";
  made.clock = std::make_unique<hal::SteadyClock>();
  hal::Clock& clock = *made.clock;
  made.safety = std::make_unique<hal::ModbusSafetyInputs>(rig.safety->options, clock);
  made.accelerometers = make_accelerometers(*rig.accelerometers, clock);
  const std::vector<std::uint32_t> ids{frame_id(*rig.torque), hal::can_frames::brake_status_id};
  auto ports = hal::split_by_id(make_can(*rig.can, ids, made), ids);
  made.torque_sensor = make_torque_sensor(*rig.torque, std::move(ports[0]), clock);
  made.brake = std::make_unique<hal::CanBrake>(std::move(ports[1]), rig.brake->options, clock);
  made.drive = std::make_unique<hal::ModbusInverter>(rig.drive.options, clock);
  return made;
}

}  // namespace rvbench::bench
