#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/recording_file.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::hal {
class ConfigReader;
}

namespace rvbench::sequences {

class BenchLoop;
struct Specimen;

/// One stretch of the timeline that --dry-run prints.
struct Segment {
  std::string what;       ///< "warm up", "settle", "record 605 rpm, 50 %, repeat 2"
  double duration_s = 0;  ///< planned; settling counts with its shortest time
  double speed_rpm = 0;   ///< at its end
  double output_torque_Nm = 0;
  bool recorded = false;
};

/// One step of a test plan. A new kind of step is a new file in sequences/phases/ and one line in
/// phase_registry.cpp.
class Phase {
 public:
  virtual ~Phase() = default;
  virtual std::string_view kind() const = 0;  ///< the word in the plan: "warm_up"

  /// Every key with its value, defaults included, as a JSON object in text.
  virtual std::string to_json() const = 0;
  virtual std::vector<Segment> timeline(const Specimen& specimen) const = 0;
  virtual std::vector<hal::PlannedPoint> points() const { return {}; }

  /// Works the rig through the loop. Empty if it went well; else how the run must end.
  /// The phase leaves the shaft as it is: stopping is the sequencer's job, on every path.
  virtual std::optional<Ending> run(BenchLoop& loop, const Specimen& specimen) = 0;
};

}  // namespace rvbench::sequences
