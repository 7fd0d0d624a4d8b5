#pragma once

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <variant>

#include "hal/accelerometers.hpp"
#include "hal/clock.hpp"
#include "hal/config_reader.hpp"
#include "hal/daq/comedi_accelerometers.hpp"
#include "hal/daq/iio_accelerometers.hpp"

namespace rvbench::bench {

/// What a rig file says of its accelerometers, on a front end that libiio reads, or on a board that
/// comedi drives:
///
///     "accelerometers": {"backend": "iio", "uri": "ip:192.168.3.30", "device": "ad7768",
///                        "rate_Hz": 4960, "range_m_s2": 490, "block_s": 0.005, "deadline_s": 0.2,
///                        "inputs": [{"name": "accel_1x", "channel": "voltage0",
///                                    "direction": "+X", "sensitivity_V_per_m_s2": 0.0102}, ...]}
///     "accelerometers": {"backend": "comedi", "device": "/dev/comedi0", "volts": 10, ...}
///
/// An input without a sensitivity tells m/s² by itself. `range_m_s2` is full scale: of the sensor,
/// or of the converter behind it if that is less.
struct AccelerometerSection {
  std::variant<hal::IioOptions, hal::ComediOptions> options;
};

/// Faults are noted at `accelerometers`.
AccelerometerSection read_accelerometer_section(hal::ConfigReader& accelerometers);

/// With every default spelled out.
nlohmann::ordered_json to_json(const AccelerometerSection& accelerometers);

/// "12 of ad7768 at ip:192.168.3.30"
std::string address_of(const AccelerometerSection& accelerometers);

std::unique_ptr<hal::Accelerometers> make_accelerometers(const AccelerometerSection& accelerometers,
                                                         hal::Clock& clock);

}  // namespace rvbench::bench
