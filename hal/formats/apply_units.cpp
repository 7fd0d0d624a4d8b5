#include "hal/formats/apply_units.hpp"

#include <fmt/format.h>

namespace rvbench::hal::formats {

void apply_units(const UnitRatio& units, FrequencyResponse& response) {
  response.response_unit = units.response.symbol;
  response.excitation_unit = units.excitation.symbol;
  const double factor = units.response.factor / units.excitation.factor;
  if (factor == 1) return;
  response.values *= factor;
  response.notes.push_back(fmt::format("values of the file times {:.10g}: into {} per {}", factor,
                                       units.response.symbol, units.excitation.symbol));
}

void apply_unit(std::string_view unit, Channel& channel, std::vector<std::string>& notes) {
  if (const std::optional<SiUnit> si = si_unit(unit)) return apply_unit(*si, channel, notes);
  channel.info.unit = said_in(unit);
}

void apply_unit(const SiUnit& unit, Channel& channel, std::vector<std::string>& notes) {
  channel.info.unit = unit.symbol;
  if (unit.factor == 1) return;
  channel.samples *= unit.factor;
  notes.push_back(fmt::format("{}: values of the file times {:.10g}: into {}", channel.info.name,
                              unit.factor, unit.symbol));
}

}  // namespace rvbench::hal::formats
