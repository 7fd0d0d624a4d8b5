#pragma once

#include <map>
#include <string>

#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {

/// What is known of a recording or a channel besides samples, by name: for formats that take
/// properties of any name. What is not known is left out.
struct Facts {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;
};

/// speed_rpm, planned_speed_rpm, load_pct, torque_Nm, repeat; rvbench_status, which nobody else
/// means otherwise; start_time (UTC, ISO 8601)
Facts facts_of(const Recording& recording);

/// start_s, sensitivity, time_uncertainty_s; direction. Name, rate and unit have their own places.
Facts facts_of(const Channel& channel);

/// The inverse: what the facts do not name stays as it is, and what is named otherwise is passed
/// over.
void apply(const Facts& facts, Recording& recording);
void apply(const Facts& facts, Channel& channel);

}  // namespace rvbench::hal::formats
