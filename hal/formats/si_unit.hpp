#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace rvbench::hal::formats {

/// A unit that a file names, and how to leave it: value in `symbol` = factor · value in the file.
struct SiUnit {
  std::string symbol;  ///< SI: "m/s²", "N", "m"; "°C" and "°F" stay, for they have another zero
  double factor = 1;
};

/// The unit that a program wrote as "g", "mm/s^2", "m/sec2", "m/s\xB2" (Latin-1), "lbf"; nothing
/// if it is not known here. "g" is the acceleration of free fall, never the gram.
std::optional<SiUnit> si_unit(std::string_view text);

/// Response per excitation.
struct UnitRatio {
  SiUnit response;
  SiUnit excitation;
};

/// What "g/N", "(m/s^2)/N" or "(1/N)*(m/s²)" says; nothing if a part is not known, or it is no
/// ratio.
std::optional<UnitRatio> unit_ratio(std::string_view text);

/// The text without blanks at its ends; empty also for the "NONE" that fills a field without value.
std::string_view said_in(std::string_view field);

}  // namespace rvbench::hal::formats
