#include "bench/can_section.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "bench/misfit.hpp"
#include "hal/can/serial_line.hpp"
#include "hal/can/slcan_frames.hpp"
#include "hal/can/socketcan_counters.hpp"
#include "hal/can/socketcan_transport.hpp"
#include "hal/json_object.hpp"
#include "hal/steady_clock.hpp"

namespace rvbench::bench {
namespace {

hal::SlcanOptions read_slcan(hal::ConfigReader& slcan) {
  hal::SlcanOptions options;
  options.device = slcan.text("device");
  options.bitrate_kbit_s = slcan.integer("bitrate_kbit_s", {10, 1000});
  options.baud = slcan.integer("baud", {1200, 4e6}, options.baud);
  if (!hal::slcan_frames::command_from_bitrate(options.bitrate_kbit_s)) {
    slcan.fault("bitrate_kbit_s", "must be 10, 20, 50, 100, 125, 250, 500, 800 or 1000");
  }
  if (!hal::SerialLine::knows_baud(options.baud)) {
    slcan.fault("baud", fmt::format("{} is no rate of a serial line", options.baud));
  }
  return options;
}

}  // namespace

CanSection read_can_section(hal::ConfigReader& can) {
  CanSection section;
  const bool has_interface = can.has("socketcan");
  auto slcan = can.optional_object("slcan");
  if (has_interface == slcan.has_value()) {
    can.fault("", R"(expected one of "socketcan" and "slcan": where the bus is)");
  }
  const std::size_t faults_before = can.faults().size();
  if (has_interface) section.bus = can.text("socketcan");
  if (slcan) section.bus = read_slcan(*slcan);
  if (can.faults().size() > faults_before || has_interface == slcan.has_value()) return section;
  try {
    hal::Rig rig;
    rig.clock = std::make_unique<hal::SteadyClock>();
    (void)make_can(section, {}, rig);  // opens nothing; knows what does not fit together
  } catch (const std::invalid_argument& error) {
    note_misfit(can, slcan ? "slcan" : "socketcan", error);
  }
  return section;
}

nlohmann::ordered_json to_json(const CanSection& can) {
  if (const auto* interface = std::get_if<std::string>(&can.bus)) {
    return hal::json_object({{"socketcan", *interface}});
  }
  const auto& slcan = std::get<hal::SlcanOptions>(can.bus);
  return hal::json_object({{"slcan", hal::json_object({{"device", slcan.device},
                                                       {"bitrate_kbit_s", slcan.bitrate_kbit_s},
                                                       {"baud", slcan.baud}})}});
}

std::string address_of(const CanSection& can) {
  if (const auto* interface = std::get_if<std::string>(&can.bus)) return *interface;
  const auto& slcan = std::get<hal::SlcanOptions>(can.bus);
  return fmt::format("{} at {} kbit/s", slcan.device, slcan.bitrate_kbit_s);
}

std::unique_ptr<hal::CanTransport> make_can(const CanSection& can, std::vector<std::uint32_t> ids,
                                            hal::Rig& rig) {
  if (const auto* interface = std::get_if<std::string>(&can.bus)) {
    auto transport =
        std::make_unique<hal::SocketcanTransport>(*interface, std::move(ids), *rig.clock);
    rig.buses.push_back(std::make_unique<hal::SocketcanCounters>(*interface));
    return transport;
  }
  hal::SlcanOptions options = std::get<hal::SlcanOptions>(can.bus);
  options.ids = std::move(ids);
  auto transport = std::make_unique<hal::SlcanTransport>(options, *rig.clock);
  rig.buses.push_back(transport->monitor());
  return transport;
}

}  // namespace rvbench::bench
