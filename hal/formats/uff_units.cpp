#include "hal/formats/uff_units.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hal/formats/fixed_columns.hpp"
#include "hal/formats/foreign_file.hpp"

namespace rvbench::hal::formats {
namespace {

std::string joined(const std::vector<std::string_view>& texts) {
  std::string all;
  for (const std::string_view text : texts) {
    if (text.empty()) continue;
    all += all.empty() ? "" : "; ";
    all += text;
  }
  return all;
}

}  // namespace

Result<std::optional<UffUnits>> read_uff_units(const std::filesystem::path& file,
                                               const std::vector<UffDataset>& datasets) {
  for (const UffDataset& dataset : datasets) {
    if (dataset.number != 164) continue;
    std::string_view rest = dataset.body;
    take_line(rest);  // code and name of the units
    std::string_view factors = take_line(rest);
    const std::optional<double> length = take_fortran_number(factors);
    const std::optional<double> force = take_fortran_number(factors);
    if (!length || !force || !(*length > 0) || !(*force > 0)) {
      return bad_file(
          file, fmt::format("{}: 164: no factors of length and force above 0", dataset.line + 2));
    }
    return std::optional<UffUnits>(UffUnits{*length, *force});
  }
  return std::optional<UffUnits>();
}

std::optional<SiUnit> unit_of(const UffAxis& axis, const std::optional<UffUnits>& units) {
  if (const std::optional<SiUnit> spelt = si_unit(axis.unit)) return spelt;
  if (!axis.unit.empty() || !units) return std::nullopt;
  switch (axis.quantity) {
    case 8: return SiUnit{"m", 1 / units->length_per_m};
    case 11: return SiUnit{"m/s", 1 / units->length_per_m};
    case 12: return SiUnit{"m/s²", 1 / units->length_per_m};
    case 9:
    case 13: return SiUnit{"N", 1 / units->force_per_N};
    case 15: return SiUnit{"Pa", units->length_per_m * units->length_per_m / units->force_per_N};
    default: return std::nullopt;
  }
}

std::vector<std::string> header_notes(const std::vector<UffDataset>& datasets) {
  std::vector<std::string> notes;
  for (const UffDataset& dataset : datasets) {
    if (dataset.number != 151) continue;
    std::string_view rest = dataset.body;
    std::vector<std::string_view> texts;
    for (int i = 0; i < 3; ++i) texts.push_back(said_in(take_line(rest)));
    if (const std::string text = joined(texts); !text.empty()) notes.push_back("header: " + text);
  }
  return notes;
}

std::string id_note(const UffFunction& function) {
  return joined({function.id_lines.begin(), function.id_lines.end()});
}

}  // namespace rvbench::hal::formats
