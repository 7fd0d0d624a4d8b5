#pragma once

#include <filesystem>
#include <optional>

#include "hal/formats/si_unit.hpp"
#include "hal/formats/uff_function.hpp"

namespace rvbench::hal::formats {

/// Data set 164: a value in SI is one of the file over these.
struct UffUnits {
  double length_per_m = 1;
  double force_per_N = 1;
};

/// The units that the file states; nothing if it states none.
Result<std::optional<UffUnits>> read_uff_units(const std::filesystem::path& file,
                                               const std::vector<UffDataset>& datasets);

/// The unit of an axis: as it is spelt there or, where it is not, by what the axis is of in the
/// units of the file; nothing if that is not stated either.
std::optional<SiUnit> unit_of(const UffAxis& axis, const std::optional<UffUnits>& units);

/// What the header (151) and the lines of text of a function say, one note each that says anything.
std::vector<std::string> header_notes(const std::vector<UffDataset>& datasets);
std::string id_note(const UffFunction& function);

}  // namespace rvbench::hal::formats
