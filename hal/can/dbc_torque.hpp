#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "hal/can/can_frames.hpp"
#include "hal/can/dbc.hpp"

namespace rvbench::hal {

/// Which signals of a DBC file a torque transducer sends, one frame per sample.
struct DbcTorqueNames {
  std::string message;
  std::string torque;       ///< in mNm, Nm or kNm ("N·m" alike)
  std::string angle;        ///< of the shaft, within a turn: in deg, rad or rev
  std::string counter;      ///< one more with each sample; its lowest 8 bits are looked at
  std::string status = {};  ///< 0 while nothing is wrong; any other value is told by its VAL_
};

using TorqueDecoder = std::function<std::optional<can_frames::TorqueFrame>(const CanFrame&)>;

/// Reads a transducer's frames by its database.
/// @return what is wrong with the names or their units instead; pointers name the key
std::variant<TorqueDecoder, std::vector<ConfigFault>> torque_decoder(const dbc::Database& database,
                                                                     const DbcTorqueNames& names);

}  // namespace rvbench::hal
