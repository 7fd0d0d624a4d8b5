#pragma once

#include <string_view>
#include <vector>

namespace rvbench {

/// Something that a plan can set a limit on, by name.
struct Measure {
  std::string_view name;                ///< "sideband_ratio": in plans, verdicts and reports
  std::vector<std::string_view> units;  ///< a limit may be in; the first is as it is measured
  std::string_view meaning;
  bool worst_is_least = false;  ///< the smallest value is the one to worry about
  double least = 0;             ///< there can be; of a pure number
  double most = 1e9;            ///< likewise
  /// Of the shafts that it is made of, at the least; empty: it is of an acceleration channel.
  std::vector<std::string_view> shaft_channels = {};
  /// When a sound record lacks it: "no mesh is heard"; empty: none may.
  std::string_view absent_when = {};
  /// The kind of a plan's phase that it is measured in; empty: in those that turn steadily.
  std::string_view phase = {};
  bool takes_repeats = false;  ///< of a point: the first alone does not show it
};

/// All there are. A measure that is not listed here cannot be limited.
const std::vector<Measure>& measures();

/// The measure of that name; nullptr if there is none.
const Measure* find_measure(std::string_view name);

/// A value in another unit: g and m/s², arcsec and rad, or the same; NaN where there is no way.
double in_unit(double value, std::string_view unit, std::string_view wanted);

/// Names that analysis gives to what it measures.
namespace measure_names {
inline constexpr std::string_view modulation_depth = "modulation_depth";
inline constexpr std::string_view acceleration_rms = "acceleration_rms";
inline constexpr std::string_view acceleration_peak = "acceleration_peak";
inline constexpr std::string_view crest_factor = "crest_factor";
inline constexpr std::string_view kurtosis = "kurtosis";
inline constexpr std::string_view band_rms = "band_rms";
inline constexpr std::string_view band_peak = "band_peak";
inline constexpr std::string_view band_crest_factor = "band_crest_factor";
inline constexpr std::string_view band_kurtosis = "band_kurtosis";
inline constexpr std::string_view order_level = "order_level";
inline constexpr std::string_view envelope_order_level = "envelope_order_level";
inline constexpr std::string_view sideband_ratio = "sideband_ratio";
inline constexpr std::string_view fm0 = "fm0";
inline constexpr std::string_view fm4 = "fm4";
inline constexpr std::string_view na4 = "na4";
inline constexpr std::string_view torque_ripple = "torque_ripple";
inline constexpr std::string_view efficiency = "efficiency";
inline constexpr std::string_view transmission_error = "transmission_error";
inline constexpr std::string_view lost_motion = "lost_motion";
inline constexpr std::string_view torsional_stiffness = "torsional_stiffness";
inline constexpr std::string_view hysteresis_width = "hysteresis_width";
}  // namespace measure_names

}  // namespace rvbench
