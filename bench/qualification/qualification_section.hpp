#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench/qualification/self_test_spec.hpp"
#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/set_point.hpp"

namespace rvbench::bench {

/// Sensors whose calibration must be on record, and still hold.
struct CalibrationDemand {
  std::vector<std::string> channels;
  double warn_days = 14;  ///< before it expires
};

/// An indicator of the golden unit that goes on a chart.
struct ChartedIndicator {
  std::string measure;  ///< a name of measures()
  std::string of = {};  ///< band, order or mesh; empty: the worst of all
};

/// A unit that is known to be as ever: when it is not, the station has changed.
struct GoldenUnitDemand {
  std::string serial;
  std::string plan;  ///< whose runs count
  double max_age_h = 168;
  int baseline_runs = 20;      ///< the first ones that passed make the chart
  std::string since_utc = {};  ///< runs before count for nothing: the chart begins anew; "": all do
  std::vector<ChartedIndicator> indicators = {{"acceleration_rms"}};
  std::vector<SetPoint> points = {};  ///< each has charts of its own; empty: the worst of all
};

/// What a rig file asks of its station before a unit may pass there:
///
///     "qualification": {
///       "station": "EOL 3",
///       "self_test": {"max_age_h": 24, "tap": true, "noise_m_s2": 0.1, ...},
///       "calibration": {"channels": ["accel_1x", "input_torque"], "warn_days": 14},
///       "golden_unit": {"serial": "GOLDEN", "plan": "quick", "max_age_h": 168,
///                       "baseline_runs": 20, "since": "2026-11-02 14:00",
///                       "indicators": [{"measure": "acceleration_rms"}],
///                       "points": [{"speed_rpm": 1210, "load_pct": 50}]}}
///
/// What is not there is not asked for. `station` is whose records count, as several benches may
/// keep theirs beside the same runs.
struct QualificationSection {
  std::string station;
  /// Of its rig file: what a simulated station shows says nothing of a bench.
  std::string rig_kind;
  std::optional<SelfTestSpec> self_test;
  std::optional<CalibrationDemand> calibration;
  std::optional<GoldenUnitDemand> golden_unit;
};

/// The section of a rig file, if it has one; faults are noted there.
/// @param rig_kind  "bench", "sim"  @param channels  those that the rig has
std::optional<QualificationSection> read_qualification_section(
    hal::ConfigReader& rig, const std::string& rig_kind, const std::vector<ChannelInfo>& channels);

/// Whether a serial is the golden unit's but for capitals and blanks: a run of it would count as
/// one of a unit like any other. @param section  null: there is no such unit
bool is_almost_golden(const QualificationSection* section, const std::string& serial);

/// What a self-test is judged by, as JSON in one line: all but how long it counts.
std::string limits_of(const SelfTestSpec& spec);

/// With every default spelled out.
nlohmann::ordered_json to_json(const QualificationSection& section);

}  // namespace rvbench::bench
