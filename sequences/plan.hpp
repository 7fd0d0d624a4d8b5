#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/recording_file.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/set_point.hpp"
#include "sequences/phase.hpp"

namespace rvbench::sequences {

/// The reducer under test, as far as a sequence must know it.
struct Specimen {
  std::string kinematics;             ///< shipped name ("rv20e") or path, for the diagnosis
  double gear_ratio = 0;              ///< input turns per output turn, > 1
  double rated_output_torque_Nm = 0;  ///< what 100 % load means
};

/// Live limits on fresh values. A trip stops the shaft first and is logged after.
struct Interlocks {
  double input_speed_rpm = 0;
  double input_torque_Nm = 0;
  double acceleration_m_s2 = 0;
  double housing_temp_degC = 0;
  double stale_after_s = 0;  ///< a value older than this is a lost device
};

/// A limit on something the diagnosis measures; declared before it is measured. It holds for the
/// worst of all channels, at the points it is for. Several that are about one value all hold: none
/// takes the place of another.
struct Limit {
  std::string measure;    ///< a name of measures()
  std::string component;  ///< for modulation_depth: which finding it bounds; empty = every one
  std::string unit;       ///< one of the measure's
  double max = 0;         ///< NaN: it is a limit from below
  std::string why;
  std::string of = {};     ///< for others: which band, order or mesh it bounds; empty = every one
  double min = not_known;  ///< NaN: it is a limit from above
  SetPoint at = {};        ///< the points it holds at; any: all together
};

struct Teardown {
  double standstill_timeout_s = 30;  ///< the brake is released at standstill or after this
  double standstill_rpm = 5;
};

/// A test, as data. Everything that a default decides is spelled out by plan_to_json().
struct TestPlan {
  std::string name;
  std::string description;
  Specimen specimen;
  double acceleration_rate_Hz = 4960;
  int channels_may_fail = 0;  ///< accelerations of a point that are left out, where they cannot be
                              ///< trusted; two thirds and four must remain
  Interlocks interlocks;
  std::vector<std::unique_ptr<Phase>> setup;
  std::vector<std::unique_ptr<Phase>> main;
  Teardown teardown;
  std::vector<Limit> limits;

  /// Every point that main will record, in order of recording.
  std::vector<hal::PlannedPoint> points() const;
};

/// The plan, or every fault of the file at once.
std::variant<TestPlan, std::vector<hal::ConfigFault>> read_plan(const std::filesystem::path& file);

std::variant<TestPlan, std::vector<hal::ConfigFault>> parse_plan(hal::ConfigReader root);

/// The resolved plan: parses back to an equal plan.
std::string plan_to_json(const TestPlan& plan);

}  // namespace rvbench::sequences
