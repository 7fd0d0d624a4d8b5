#include "hal/formats/uff_frequency_responses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "hal/formats/apply_units.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/uff_units.hpp"
#include "hal/types/units.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr int frequency_code = 18;

// Hz per unit of the abscissa; nothing if it is no frequency.
std::optional<double> hertz_of(const UffAxis& axis) {
  const std::optional<SiUnit> unit = si_unit(axis.unit);
  if (!unit && (axis.unit.empty() || axis.quantity == frequency_code)) return 1;
  if (unit && unit->symbol == "Hz") return unit->factor;
  if (unit && unit->symbol == "rad/s") return unit->factor / units::two_pi;
  return std::nullopt;
}

std::optional<std::string> find_fault(const UffFunction& function) {
  if (!function.is_whole()) {
    return fmt::format("{} values declared, {} found", function.declared, function.found);
  }
  if (function.declared == 0) return "no values";
  if (!hertz_of(function.abscissa)) return "over what is no frequency";
  if (!function.step) return "frequencies rise unevenly";
  if (function.first < 0) return "frequencies below 0";
  return std::nullopt;
}

void note_gaps(FrequencyResponse& response) {
  const Eigen::Index gaps = (!response.values.array().isFinite()).count();
  if (gaps > 0) response.notes.push_back(fmt::format("{} lines are no number", gaps));
}

void set_units(const UffFunction& function, const std::optional<UffUnits>& file_units,
               FrequencyResponse& response) {
  const std::optional<SiUnit> over = unit_of(function.numerator, file_units);
  const std::optional<SiUnit> under = unit_of(function.denominator, file_units);
  if (over && under) return apply_units({*over, *under}, response);
  if (const auto both = unit_ratio(function.numerator.unit)) return apply_units(*both, response);
  response.notes.push_back(fmt::format("units not known: \"{}\" over \"{}\", values as in the file",
                                       function.numerator.unit, function.denominator.unit));
}

FrequencyResponse response_of(const UffFunction& function, const std::optional<UffUnits>& units,
                              const std::filesystem::path& file) {
  FrequencyResponse response;
  response.source = file.string() + ": " + place_of(function);
  response.response = function.response;
  response.excitation = function.reference;
  const double unit_Hz = hertz_of(function.abscissa).value_or(1);
  response.first_Hz = function.first * unit_Hz;
  response.step_Hz = function.step.value_or(1) * unit_Hz;
  response.values = function.values;
  if (const std::string said = id_note(function); !said.empty()) response.notes.push_back(said);
  set_units(function, units, response);
  note_gaps(response);
  return response;
}

bool is_of(const FrequencyResponse& coherence, const FrequencyResponse& response) {
  return response.coherence.size() == 0 && coherence.response == response.response &&
         coherence.excitation == response.excitation &&
         coherence.values.size() == response.values.size() &&
         coherence.first_Hz == response.first_Hz && coherence.step_Hz == response.step_Hz;
}

void attach(const FrequencyResponse& coherence, std::vector<FrequencyResponse>& responses) {
  const auto own = std::find_if(responses.begin(), responses.end(),
                                [&](const auto& response) { return is_of(coherence, response); });
  if (own == responses.end()) {
    responses.front().notes.push_back(coherence.source + ": a coherence of none that is here");
    return;
  }
  own->coherence = coherence.values.real();
  const bool sound = (own->coherence.array() >= 0).all() && (own->coherence.array() <= 1).all();
  if (sound) return;
  own->coherence.resize(0);
  own->notes.push_back(coherence.source + ": a coherence not within 0 to 1 is left out");
}

}  // namespace

Result<std::vector<FrequencyResponse>> read_uff_frequency_responses(
    const std::filesystem::path& file, std::string_view bytes) {
  const std::vector<UffDataset> datasets = uff_datasets(bytes);
  const auto units = read_uff_units(file, datasets);
  if (!units) return units.error();
  std::vector<FrequencyResponse> responses, coherences;
  std::string others;
  std::set<int> other_types;
  for (const UffDataset& dataset : datasets) {
    if (dataset.number != 58) continue;
    const Result<UffFunction> read = read_uff_function(file, dataset);
    if (!read) return read.error();
    const UffFunction& function = read.value();
    const bool is_response = function.is(UffFunctionType::frequency_response);
    if (!is_response && !function.is(UffFunctionType::coherence)) {
      if (other_types.insert(function.type).second) {
        others += ", " + name_of_type(function.type) + " (58)";
      }
      continue;
    }
    std::optional<std::string> fault = find_fault(function);
    if (is_response && !function.is_complex) fault = "real values only: it lacks the phase";
    if (fault) {
      return bad_file(
          file, fmt::format("{}: {}: {}", place_of(function), name_of_type(function.type), *fault));
    }
    (is_response ? responses : coherences).push_back(response_of(function, units.value(), file));
  }
  if (responses.empty()) {
    return bad_file(
        file, fmt::format("holds {}{}, no frequency response", contents_of(datasets), others));
  }
  for (const FrequencyResponse& coherence : coherences) attach(coherence, responses);
  const std::vector<std::string> notes = header_notes(datasets);
  for (FrequencyResponse& response : responses) {
    response.notes.insert(response.notes.begin(), notes.begin(), notes.end());
  }
  return responses;
}

}  // namespace rvbench::hal::formats
