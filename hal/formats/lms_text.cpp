#include "hal/formats/lms_text.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <string>

#include "hal/formats/apply_units.hpp"
#include "hal/formats/even_grid.hpp"
#include "hal/formats/fixed_columns.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/uff_datasets.hpp"

namespace rvbench::hal::formats {
namespace {

// Key and value of each line before the table, as they are written.
using Header = std::map<std::string_view, std::string_view>;

std::string_view value_of(const Header& header, std::string_view key) {
  const auto found = header.find(key);
  return found == header.end() ? std::string_view() : found->second;
}

bool begins_with_number(std::string_view line) {
  return take_fortran_number(line).has_value() && (line.empty() || line.front() == '\t');
}

// Takes the lines of the header off `rest`; how many they are is returned.
std::size_t take_header(std::string_view& rest, Header& header) {
  std::size_t lines = 0;
  for (; !rest.empty(); ++lines) {
    std::string_view after = rest;
    const std::string_view line = take_line(after);
    if (begins_with_number(line)) break;
    rest = after;
    const std::size_t tab = line.find('\t');
    if (tab == std::string_view::npos) continue;
    const std::string_view value = line.substr(tab + 1);
    header[said_in(line.substr(0, tab))] = said_in(value.substr(0, value.find('\t')));
  }
  return lines;
}

// Frequency, real and imaginary part of each line.
struct Table {
  std::vector<std::array<double, 3>> lines;

  std::optional<std::string> fill(std::string_view rest, std::size_t line) {
    for (; !rest.empty(); ++line) {
      std::string_view text = take_line(rest);
      if (said_in(text).empty()) continue;
      std::array<double, 3> numbers{};
      for (double& number : numbers) {
        const std::optional<double> taken = take_fortran_number(text);
        if (!taken) return fmt::format("{}: not frequency, real and imaginary part", line);
        number = *taken;
      }
      if (!said_in(text).empty()) {
        return fmt::format("{}: more than frequency, real and imaginary part", line);
      }
      lines.push_back(numbers);
    }
    return std::nullopt;
  }
};

std::optional<std::string> find_fault(const Header& header, const Table& table) {
  const std::string_view kind = value_of(header, "Function class");
  const bool is_ratio = value_of(header, "Y axis quantity").find("Over") != std::string_view::npos;
  if (kind.empty() ? !is_ratio : kind != "FRF") {
    return fmt::format("holds {}, no frequency response",
                       kind.empty() ? value_of(header, "Y axis quantity") : kind);
  }
  if (const std::string_view type = value_of(header, "Value type"); type != "Complex") {
    return fmt::format("values are {}, not complex", type.empty() ? "of no stated type" : type);
  }
  if (const std::string_view unit = value_of(header, "X axis unit"); unit != "Hz") {
    return fmt::format("X axis unit is \"{}\", not Hz", unit);
  }
  const auto declared = Columns(value_of(header, "Number of lines")).integer();
  if (!declared || (*declared != 0 && static_cast<std::size_t>(*declared) != table.lines.size())) {
    return fmt::format("{} lines declared, {} found", value_of(header, "Number of lines"),
                       table.lines.size());
  }
  return std::nullopt;
}

struct PlaceKeys {
  std::string_view point, direction, whole;
};
constexpr PlaceKeys response_keys{"Point id", "Point direction", "DOF id"};
constexpr PlaceKeys reference_keys{"Reference point id", "Reference point direction",
                                   "Reference DOF id"};

// "Point:10:-Z" by its parts, or as it is.
DegreeOfFreedom place_of(const Header& header, const PlaceKeys& keys) {
  DegreeOfFreedom place{std::string(value_of(header, keys.point)),
                        std::string(value_of(header, keys.direction))};
  if (place.point.empty()) place.point = value_of(header, keys.whole);
  return place;
}

void add_notes(const Header& header, FrequencyResponse& response) {
  for (const std::string_view key :
       {"FRF estimation method", "Span", "Reference actual sensitivity", "Actual sensitivity",
        "Reference window type", "Window type", "Original run", "Overload"}) {
    const std::string_view value = value_of(header, key);
    if (!value.empty()) response.notes.push_back(fmt::format("{}: {}", key, value));
  }
}

void set_units(const Header& header, FrequencyResponse& response) {
  const std::string_view unit = value_of(header, "Y axis unit");
  if (const std::optional<UnitRatio> ratio = unit_ratio(unit)) {
    apply_units(*ratio, response);
  } else {
    response.notes.push_back(fmt::format("unit \"{}\" is not known, values as in the file", unit));
  }
}

}  // namespace

bool is_lms_text(std::string_view head) {
  bool has_axis = false, has_values = false;
  while (!head.empty()) {
    const std::string_view line = take_line(head);
    if (line.find('\0') != std::string_view::npos) return false;
    has_axis = has_axis || line.starts_with("X axis quantity\t");
    has_values = has_values || line.starts_with("Value type\t");
  }
  return has_axis && has_values;
}

Result<std::vector<FrequencyResponse>> read_lms_frequency_response(
    const std::filesystem::path& file, std::string_view bytes) {
  Header header;
  const std::size_t header_lines = take_header(bytes, header);
  Table table;
  if (const auto fault = table.fill(bytes, header_lines + 1)) return bad_file(file, *fault);
  if (const auto fault = find_fault(header, table)) return bad_file(file, *fault);

  const auto lines = static_cast<Eigen::Index>(table.lines.size());
  Eigen::VectorXd frequencies_Hz(lines);
  FrequencyResponse response;
  response.values.resize(lines);
  for (Eigen::Index i = 0; i < lines; ++i) {
    const std::array<double, 3>& line = table.lines[static_cast<std::size_t>(i)];
    frequencies_Hz[i] = line[0];
    response.values[i] = {line[1], line[2]};
  }
  const std::optional<double> step_Hz = even_step(frequencies_Hz);
  if (!step_Hz || frequencies_Hz[0] < 0) {
    return bad_file(file, "frequencies do not rise evenly from 0 or above");
  }
  response.source = file.string();
  response.first_Hz = frequencies_Hz[0];
  response.step_Hz = *step_Hz;
  response.response = place_of(header, response_keys);
  response.excitation = place_of(header, reference_keys);
  response.averages = Columns(value_of(header, "Number of averages")).integer().value_or(0);
  add_notes(header, response);
  set_units(header, response);
  return std::vector<FrequencyResponse>{std::move(response)};
}

}  // namespace rvbench::hal::formats
