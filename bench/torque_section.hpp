#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "hal/can/canopen_torque_sensor.hpp"
#include "hal/can/dbc_torque.hpp"
#include "hal/can_transport.hpp"
#include "hal/clock.hpp"
#include "hal/config_reader.hpp"
#include "hal/torque_sensor.hpp"

namespace rvbench::bench {

/// What a rig file says of its torque transducer, which is on the CAN bus:
///
///     "torque": {"frames": "rvbench", "rate_Hz": 500, "deadline_s": 0.2}
///
/// "rvbench" is frame 0x181 of hal/can/can_frames. Frames that a DBC file tells are
///
///     "frames": {"dbc": {"file": "transducer.dbc", "message": "Torque", "torque": "Mz",
///                        "angle": "Phi", "counter": "Count", "status": "Status"}}
///
/// ("status" may be left out), and those of CANopen transducers that send when their value changes
///
///     "frames": {"canopen": {"node": 1, "Nm_per_count": 0.001}}
struct TorqueSection {
  struct RvbenchFrames {};
  struct DbcFrames {
    std::string file;
    hal::DbcTorqueNames names;
    std::uint32_t id = 0;
    hal::TorqueDecoder decode;
  };
  struct CanopenFrames {
    int node = 1;
    double Nm_per_count = 1e-3;
  };

  std::variant<RvbenchFrames, DbcFrames, CanopenFrames> frames;
  double rate_Hz = 500;
  double deadline_s = 0.2;
};

/// Faults are noted at `torque`.
TorqueSection read_torque_section(hal::ConfigReader& torque);

/// With every default spelled out.
nlohmann::ordered_json to_json(const TorqueSection& torque);

/// "rvbench frames 0x181 at 500 Hz"
std::string shown(const TorqueSection& torque);

/// Why no run can do with it; empty if one can.
std::string unfit_for_runs(const TorqueSection& torque);

/// Identifier of its frames. @pre unfit_for_runs() is empty, here and below
std::uint32_t frame_id(const TorqueSection& torque);
std::unique_ptr<hal::TorqueSensor> make_torque_sensor(const TorqueSection& torque,
                                                      std::unique_ptr<hal::CanTransport> transport,
                                                      hal::Clock& clock);

}  // namespace rvbench::bench
