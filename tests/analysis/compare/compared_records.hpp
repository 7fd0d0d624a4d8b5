#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "analysis/compare/comparison.hpp"
#include "tests/analysis/order_signals.hpp"

namespace rvbench::test {

/// A pinion of 8 teeth on the input shaft, and a wheel of 24: the train repeats every 3 turns.
inline analysis::Kinematics small_gear() {
  analysis::Kinematics k;
  k.machine = "small gear";
  k.period_turns = 3;
  k.orders = {{"input shaft", 1, {}, "input_shaft", ""},
              {"wheel shaft", 1.0 / 3, {}, "wheel", ""},
              {"mesh", 8, {}, "pinion", "", true}};
  return k;
}

/// Amplitudes of its lines, and what else a record of it is made of.
struct GearRecord {
  double shaft = 0.5, mesh = 1, noise = 0.3;
  double scatter_dB = 0;       ///< of both amplitudes, from record to record
  Eigen::Index count = 12000;  ///< 120 turns: not quite two blocks
  double speed_Hz = 20, load_pct = 50;
};

/// One record with an encoder, drawn by a seed.
inline Recording gear_record(const GearRecord& of, unsigned seed,
                             const char* channel = "accel_1x") {
  std::mt19937 engine(seed + 1000);
  std::normal_distribution<double> gaussian;
  const auto drawn = [&] { return std::pow(10, of.scatter_dB * gaussian(engine) / 20); };
  const OrderSignals signals{.speed_Hz = of.speed_Hz, .count = of.count};
  Recording record = signals.recording(of.shaft * drawn() * signals.tone(1, seed) +
                                       of.mesh * drawn() * signals.tone(8, 2.0 * seed) +
                                       of.noise * signals.noise(seed));
  record.source = "record " + std::to_string(seed);
  record.planned_speed_rpm = of.speed_Hz * 60;
  record.load_pct = of.load_pct;
  record.status = "ok";
  record.channels.front().info.name = channel;
  return record;
}

inline std::vector<analysis::RecordLevels> measured(
    const std::vector<Recording>& records, const analysis::Kinematics& kinematics = small_gear()) {
  std::vector<analysis::RecordLevels> levels;
  for (const Recording& record : records) {
    levels.push_back(
        analysis::measure_levels(record, kinematics, analysis::quantities_to_compare(kinematics)));
  }
  return levels;
}

/// So many repeats of one point.
inline std::vector<Recording> repeats(const GearRecord& of, unsigned count, unsigned seed) {
  std::vector<Recording> records;
  for (unsigned i = 0; i < count; ++i) records.push_back(gear_record(of, 10 * seed + i));
  return records;
}

inline analysis::Comparison compared(const std::vector<Recording>& a,
                                     const std::vector<Recording>& b,
                                     const analysis::CompareOptions& options = {}) {
  return analysis::compare(measured(a), measured(b), analysis::quantities_to_compare(small_gear()),
                           options);
}

/// The change of a quantity at the first point, or nullptr.
inline const analysis::Change* change_of(const analysis::Comparison& comparison,
                                         const std::string& quantity) {
  for (const analysis::Change& change : comparison.changes) {
    if (comparison.quantities[change.quantity].name == quantity) return &change;
  }
  return nullptr;
}

}  // namespace rvbench::test
