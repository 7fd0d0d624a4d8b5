#include "hal/formats/table/settings.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>

#include "hal/formats/csv_cells.hpp"
#include "hal/formats/si_unit.hpp"
#include "hal/formats/table/number_marks.hpp"

namespace rvbench::hal::formats {
namespace {

enum class Says { rate, interval, unit, speed };

struct Setting {
  std::string_view name;  // in lower case, letters and digits alone
  Says says;
  double per_unit = 0;  // Hz, s or rpm of a number without a unit; 0: it needs one
};

// A new spelling is a new row.
constexpr std::array known_settings = {
    Setting{"samplerate", Says::rate, 1},
    Setting{"samplingrate", Says::rate, 1},
    Setting{"samplefrequency", Says::rate, 1},
    Setting{"samplingfrequency", Says::rate, 1},
    Setting{"samplefreq", Says::rate, 1},
    Setting{"samplingfreq", Says::rate, 1},
    Setting{"samplespersecond", Says::rate, 1},
    Setting{"acquisitionrate", Says::rate, 1},
    Setting{"scanrate", Says::rate, 1},
    Setting{"rate", Says::rate, 1},
    Setting{"fs", Says::rate, 1},
    Setting{"ratehz", Says::rate, 1},
    Setting{"fshz", Says::rate, 1},
    Setting{"sampleratehz", Says::rate, 1},
    Setting{"samplingratehz", Says::rate, 1},
    Setting{"samplingfrequencyhz", Says::rate, 1},
    Setting{"sampleratekhz", Says::rate, 1e3},
    Setting{"samplingratekhz", Says::rate, 1e3},
    Setting{"abtastrate", Says::rate, 1},
    Setting{"abtastfrequenz", Says::rate, 1},
    Setting{"sampleinterval", Says::interval},
    Setting{"samplinginterval", Says::interval},
    Setting{"sampleperiod", Says::interval},
    Setting{"samplingperiod", Says::interval},
    Setting{"sampletime", Says::interval},
    Setting{"timestep", Says::interval},
    Setting{"timeincrement", Says::interval},
    Setting{"dt", Says::interval},
    Setting{"dts", Says::interval, 1},
    Setting{"dtms", Says::interval, 1e-3},
    Setting{"sampleintervals", Says::interval, 1},
    Setting{"sampleintervalms", Says::interval, 1e-3},
    Setting{"sampleperiods", Says::interval, 1},
    Setting{"deltax", Says::interval, 1},  // LabVIEW: its X is time in s
    Setting{"unit", Says::unit},
    Setting{"units", Says::unit},
    Setting{"yunit", Says::unit},
    Setting{"yunits", Says::unit},
    Setting{"yunitlabel", Says::unit},
    Setting{"verticalunit", Says::unit},
    Setting{"verticalunits", Says::unit},
    Setting{"einheit", Says::unit},
    Setting{"speedrpm", Says::speed, 1},
    Setting{"rpm", Says::speed, 1},
};

std::string letters_of(std::string_view text) {
  std::string out;
  for (const unsigned char c : text) {
    if (std::isalnum(c) != 0) out += static_cast<char>(std::tolower(c));
  }
  return out;
}

// The name and the values of a setting: "name,value,value", "name: value" or "name = value".
std::vector<std::string_view> parts_of(std::string_view line, char separator) {
  auto cells = csv_cells(line, separator).value_or(std::vector<std::string_view>{line});
  if (separator == ' ' || cells.size() < 2) cells = {line};
  const std::size_t mark = cells.front().find_first_of(":=");
  if (mark != std::string_view::npos) {
    const std::string_view first = cells.front();
    cells.front() = said_in(first.substr(0, mark));
    const std::string_view value = said_in(first.substr(mark + 1));
    if (!value.empty()) cells.insert(cells.begin() + 1, value);
  }
  return cells;
}

const Setting* setting_of(std::string_view name) {
  const std::string asked = letters_of(name);
  const auto found = std::ranges::find(known_settings, asked, &Setting::name);
  return found == known_settings.end() ? nullptr : &*found;
}

struct Quantity {
  double value = 0;
  std::string unit;
};

// "25.6 kHz", or "25.6" and "kHz" in two cells; the comma may be the decimal mark.
std::optional<Quantity> quantity_in(const std::vector<std::string_view>& parts) {
  if (parts.size() < 2) return std::nullopt;
  const std::string_view text = parts[1];
  const std::size_t end = std::min(text.find_first_not_of("+-0123456789.,eE"), text.size());
  const std::string_view number = said_in(text.substr(0, end));
  const bool has_comma = number.find(',') != number.npos;
  if (has_comma && number_in(number, {'.', ','})) return std::nullopt;  // 25,600 may be 25.6
  const NumberStyle style = has_comma ? NumberStyle{',', '\0'} : NumberStyle{};
  const auto value = may_be_number(number) ? number_in(number, style) : std::nullopt;
  if (!value) return std::nullopt;
  std::string_view unit = said_in(text.substr(end));
  if (unit.empty() && parts.size() > 2 && !may_be_number(parts[2])) unit = parts[2];
  return Quantity{*value, std::string(unit)};
}

// Hz, s or rpm; nothing if the unit is another one, or is needed and missing.
std::optional<double> value_of(const Setting& setting, const Quantity& quantity) {
  if (quantity.unit.empty()) {
    return setting.per_unit > 0 ? std::optional(quantity.value * setting.per_unit) : std::nullopt;
  }
  const std::string spelt = letters_of(quantity.unit);
  if (setting.says == Says::speed) {
    return spelt == "rpm" || spelt == "1min" ? std::optional(quantity.value) : std::nullopt;
  }
  const bool per_second = spelt == "ss" || spelt == "sas" || spelt == "sps" ||
                          spelt == "sampless" || spelt == "samplessec" ||
                          spelt == "samplespersecond";
  if (setting.says == Says::rate && per_second) return quantity.value;
  const auto si = si_unit(quantity.unit);
  const std::string_view asked = setting.says == Says::rate ? "Hz" : "s";
  return si && si->symbol == asked ? std::optional(quantity.value * si->factor) : std::nullopt;
}

}  // namespace

TableSettings settings_in(const std::vector<std::string>& above, char separator) {
  TableSettings found;
  bool contradicts = false;
  for (const std::string& line : above) {
    const auto parts = parts_of(line, separator);
    const Setting* setting = parts.empty() ? nullptr : setting_of(parts.front());
    if (setting == nullptr || parts.size() < 2) continue;
    if (setting->says == Says::unit) {
      found.units.assign(parts.begin() + 1, parts.end());
      continue;
    }
    const auto quantity = quantity_in(parts);
    const auto value = quantity ? value_of(*setting, *quantity) : std::nullopt;
    if (!value || !(*value > 0)) continue;
    if (setting->says == Says::speed) {
      found.speed_rpm = *value;
      continue;
    }
    const double rate_Hz = setting->says == Says::rate ? *value : 1 / *value;
    contradicts =
        contradicts || (found.rate_Hz && std::abs(*found.rate_Hz - rate_Hz) > 1e-6 * rate_Hz);
    found.rate_Hz = rate_Hz;
    found.rate_line = line;
  }
  if (contradicts) found.rate_Hz.reset();
  return found;
}

}  // namespace rvbench::hal::formats
