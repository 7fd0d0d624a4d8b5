#pragma once

#include <optional>
#include <string>

namespace rvbench {

/// Points of a plan's matrix, by the speed and load that are set there.
struct SetPoint {
  std::optional<double> speed_rpm = {};  ///< of the input; nothing: any
  std::optional<double> load_pct = {};   ///< of rated output torque; nothing: any

  bool operator==(const SetPoint&) const = default;
  bool is_any() const { return !speed_rpm && !load_pct; }

  /// Whether a point with that planned speed and load is one of them; NaN is in none but any.
  bool includes(double planned_speed_rpm, double planned_load_pct) const;
};

/// Whether every point of `part` is one of `whole`.
bool covers(const SetPoint& whole, const SetPoint& part);

/// Whether a point could be of both.
bool overlap(const SetPoint& a, const SetPoint& b);

/// "1815 rpm, 100 % load"; empty of any.
std::string text_of(const SetPoint& at);

/// " at 1815 rpm, 100 % load"; empty of any.
std::string at_text(const SetPoint& at);

}  // namespace rvbench
