#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>
#include <vector>

#include "hal/can/slcan_transport.hpp"
#include "hal/config_reader.hpp"
#include "hal/rig.hpp"

namespace rvbench::bench {

/// What a rig file says of its CAN bus:
///
///     "can": {"socketcan": "can0"}
///     "can": {"slcan": {"device": "/dev/ttyACM0", "bitrate_kbit_s": 500, "baud": 115200}}
///
/// A SocketCAN interface has its bit rate from whoever sets it up: `ip link set can0 up type can
/// bitrate 500000`.
struct CanSection {
  std::variant<std::string, hal::SlcanOptions> bus;  ///< a SocketCAN interface, or an adapter
};

/// Faults are noted at `can`.
CanSection read_can_section(hal::ConfigReader& can);

/// With every default spelled out.
nlohmann::ordered_json to_json(const CanSection& can);

/// "can0" or "/dev/ttyACM0 at 500 kbit/s"
std::string address_of(const CanSection& can);

/// The bus, not yet open, as devices with these identifiers see it; its monitor goes to the rig.
/// @pre rig.clock
std::unique_ptr<hal::CanTransport> make_can(const CanSection& can, std::vector<std::uint32_t> ids,
                                            hal::Rig& rig);

}  // namespace rvbench::bench
