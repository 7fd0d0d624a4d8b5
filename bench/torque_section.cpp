#include "bench/torque_section.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/text_file.hpp"
#include "hal/can/can_frames.hpp"
#include "hal/can/can_torque_sensor.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;
using Rvbench = TorqueSection::RvbenchFrames;
using Dbc = TorqueSection::DbcFrames;
using Canopen = TorqueSection::CanopenFrames;

Dbc read_dbc(hal::ConfigReader& dbc) {
  Dbc frames;
  const std::size_t faults_before = dbc.faults().size();
  frames.file = dbc.text("file");
  frames.names = {.message = dbc.text("message"),
                  .torque = dbc.text("torque"),
                  .angle = dbc.text("angle"),
                  .counter = dbc.text("counter"),
                  .status = dbc.text("status", "")};
  if (dbc.faults().size() > faults_before) return frames;
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(frames.file, ignored);
  const auto text = is_file ? read_file(frames.file) : std::nullopt;
  if (!text) {
    dbc.fault("file", "cannot be read: " + frames.file);
    return frames;
  }
  const auto database = hal::dbc::parse(*text);
  if (database.index() == 1) {
    for (const hal::ConfigFault& fault : std::get<1>(database)) {
      dbc.fault("file", hal::describe(frames.file, fault));
    }
    return frames;
  }
  auto decoder = hal::torque_decoder(std::get<0>(database), frames.names);
  if (decoder.index() == 1) {
    for (const hal::ConfigFault& fault : std::get<1>(decoder)) {
      dbc.fault(fault.pointer.substr(1), frames.file + ": " + fault.message);
    }
    return frames;
  }
  frames.id = std::get<0>(database).find(frames.names.message)->id;
  frames.decode = std::get<0>(std::move(decoder));
  return frames;
}

Canopen read_canopen(hal::ConfigReader& canopen) {
  Canopen frames;
  frames.node = canopen.integer("node", {1, 127});
  frames.Nm_per_count = canopen.number("Nm_per_count", {1e-9, 1e3}, frames.Nm_per_count);
  return frames;
}

// The one kind of frames that a word is enough for.
void read_frames_word(hal::ConfigReader& torque) {
  if (!torque.has("frames")) return torque.fault("frames", "this key is missing");
  const std::string word = torque.text("frames");
  if (word == "rvbench") return;
  std::string example;
  if (word == "dbc") {
    example = R"(; a DBC file is {"dbc": {"file": ..., "message": ..., "torque": ..., )"
              R"("angle": ..., "counter": ...}})";
  }
  if (word == "canopen") example = R"(; such a node is {"canopen": {"node": ...}})";
  torque.fault("frames",
               R"(expected "rvbench", or an object with one of "dbc" and "canopen"; found )" +
                   hal::in_quotes(word) + hal::did_you_mean(word, {"rvbench"}) + example);
}

void read_frames(hal::ConfigReader& torque, TorqueSection& section) {
  if (torque.is_text("frames") || !torque.has("frames")) {
    read_frames_word(torque);
    return;
  }
  hal::ConfigReader frames = torque.object("frames");
  auto dbc = frames.optional_object("dbc");
  auto canopen = frames.optional_object("canopen");
  if (dbc.has_value() == canopen.has_value()) {
    frames.fault("", R"(expected "rvbench", or one of "dbc" and "canopen")");
  }
  if (dbc) section.frames = read_dbc(*dbc);
  if (canopen) section.frames = read_canopen(*canopen);
}

Json to_json(const Rvbench&) { return "rvbench"; }

Json to_json(const Dbc& dbc) {
  Json json = hal::json_object({{"file", dbc.file},
                                {"message", dbc.names.message},
                                {"torque", dbc.names.torque},
                                {"angle", dbc.names.angle},
                                {"counter", dbc.names.counter}});
  if (!dbc.names.status.empty()) json["status"] = dbc.names.status;
  return hal::json_object({{"dbc", json}});
}

Json to_json(const Canopen& canopen) {
  return hal::json_object(
      {{"canopen",
        hal::json_object({{"node", canopen.node}, {"Nm_per_count", canopen.Nm_per_count}})}});
}

}  // namespace

TorqueSection read_torque_section(hal::ConfigReader& torque) {
  TorqueSection section;
  read_frames(torque, section);
  section.rate_Hz = torque.number("rate_Hz", {10, 10'000});
  section.deadline_s = torque.number("deadline_s", {0.02, 2}, section.deadline_s);
  return section;
}

Json to_json(const TorqueSection& torque) {
  return hal::json_object(
      {{"frames", std::visit([](const auto& kind) { return to_json(kind); }, torque.frames)},
       {"rate_Hz", torque.rate_Hz},
       {"deadline_s", torque.deadline_s}});
}

std::string shown(const TorqueSection& torque) {
  if (const auto* canopen = std::get_if<Canopen>(&torque.frames)) {
    return fmt::format("CANopen node {}", canopen->node);
  }
  const auto* dbc = std::get_if<Dbc>(&torque.frames);
  return fmt::format("{} frames 0x{:03X} at {:g} Hz", dbc ? dbc->file : "rvbench", frame_id(torque),
                     torque.rate_Hz);
}

std::string unfit_for_runs(const TorqueSection& torque) {
  if (!std::holds_alternative<Canopen>(torque.frames)) return "";
  return "a run needs the angle of the input shaft, which tells its speed, its turns and its "
         "standstill whatever the drive says: a transducer that sends torque only when it has "
         "changed gives none";
}

std::uint32_t frame_id(const TorqueSection& torque) {
  const auto* dbc = std::get_if<Dbc>(&torque.frames);
  return dbc ? dbc->id : hal::can_frames::torque_id;
}

std::unique_ptr<hal::TorqueSensor> make_torque_sensor(const TorqueSection& torque,
                                                      std::unique_ptr<hal::CanTransport> transport,
                                                      hal::Clock& clock) {
  hal::CanTorqueSensorOptions options;
  options.rate_Hz = torque.rate_Hz;
  options.deadline_s = torque.deadline_s;
  if (const auto* dbc = std::get_if<Dbc>(&torque.frames)) options.decode = dbc->decode;
  return std::make_unique<hal::CanTorqueSensor>(std::move(transport), options, clock);
}

}  // namespace rvbench::bench
