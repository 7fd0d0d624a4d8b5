#include "hal/formats/si_unit.hpp"

#include <array>
#include <utility>

#include "hal/types/units.hpp"

namespace rvbench::hal::formats {
namespace {

struct Spelling {
  std::string_view text;  // as `plain` leaves it
  std::string_view symbol;
  double factor;
};

constexpr std::array spellings = {
    Spelling{"m/s2", "m/s²", 1},
    Spelling{"m/sec2", "m/s²", 1},
    Spelling{"m/s/s", "m/s²", 1},
    Spelling{"ms-2", "m/s²", 1},
    Spelling{"g", "m/s²", units::standard_gravity_m_s2},
    Spelling{"G", "m/s²", units::standard_gravity_m_s2},
    Spelling{"g's", "m/s²", units::standard_gravity_m_s2},
    Spelling{"gs", "m/s²", units::standard_gravity_m_s2},
    Spelling{"G's", "m/s²", units::standard_gravity_m_s2},
    Spelling{"Gs", "m/s²", units::standard_gravity_m_s2},
    Spelling{"gn", "m/s²", units::standard_gravity_m_s2},
    Spelling{"mg", "m/s²", 1e-3 * units::standard_gravity_m_s2},
    Spelling{"mm/s2", "m/s²", 1e-3},
    Spelling{"mm/sec2", "m/s²", 1e-3},
    Spelling{"cm/s2", "m/s²", 1e-2},
    Spelling{"in/s2", "m/s²", units::inch_m},
    Spelling{"in/sec2", "m/s²", units::inch_m},
    Spelling{"ft/s2", "m/s²", units::foot_m},
    Spelling{"m/s", "m/s", 1},
    Spelling{"m/sec", "m/s", 1},
    Spelling{"mm/s", "m/s", 1e-3},
    Spelling{"mm/sec", "m/s", 1e-3},
    Spelling{"in/s", "m/s", units::inch_m},
    Spelling{"in/sec", "m/s", units::inch_m},
    Spelling{"ips", "m/s", units::inch_m},
    Spelling{"m", "m", 1},
    Spelling{"cm", "m", 1e-2},
    Spelling{"mm", "m", 1e-3},
    Spelling{"um", "m", 1e-6},
    Spelling{"in", "m", units::inch_m},
    Spelling{"mil", "m", 1e-3 * units::inch_m},
    Spelling{"ft", "m", units::foot_m},
    Spelling{"N", "N", 1},
    Spelling{"Newton", "N", 1},
    Spelling{"mN", "N", 1e-3},
    Spelling{"kN", "N", 1e3},
    Spelling{"lbf", "N", units::pound_force_N},
    Spelling{"lb", "N", units::pound_force_N},
    Spelling{"lbs", "N", units::pound_force_N},
    Spelling{"kgf", "N", units::kilogram_force_N},
    Spelling{"kp", "N", units::kilogram_force_N},
    Spelling{"Nm", "N·m", 1},
    Spelling{"kNm", "N·m", 1e3},
    Spelling{"Nmm", "N·m", 1e-3},
    Spelling{"lbfin", "N·m", units::pound_force_N* units::inch_m},
    Spelling{"lbfft", "N·m", units::pound_force_N* units::foot_m},
    Spelling{"rad", "rad", 1},
    Spelling{"deg", "rad", units::degree_rad},
    Spelling{"rad/s", "rad/s", 1},
    Spelling{"deg/s", "rad/s", units::degree_rad},
    Spelling{"rpm", "rad/s", units::rad_s_from_rpm(1)},
    Spelling{"RPM", "rad/s", units::rad_s_from_rpm(1)},
    Spelling{"rad/s2", "rad/s²", 1},
    Spelling{"deg/s2", "rad/s²", units::degree_rad},
    Spelling{"Pa", "Pa", 1},
    Spelling{"kPa", "Pa", 1e3},
    Spelling{"MPa", "Pa", 1e6},
    Spelling{"bar", "Pa", 1e5},
    Spelling{"degC", "°C", 1},
    Spelling{"degF", "°F", 1},
    Spelling{"K", "K", 1},
    Spelling{"V", "V", 1},
    Spelling{"Volts", "V", 1},
    Spelling{"mV", "V", 1e-3},
    Spelling{"A", "A", 1},
    Spelling{"s", "s", 1},
    Spelling{"sec", "s", 1},
    Spelling{"ms", "s", 1e-3},
    Spelling{"us", "s", 1e-6},
    Spelling{"ns", "s", 1e-9},
    Spelling{"Hz", "Hz", 1},
    Spelling{"kHz", "Hz", 1e3},
};

constexpr std::pair<std::string_view, std::string_view> replacements[] = {
    {"\xC2\xB2", "2"},  // UTF-8
    {"\xC2\xB7", ""},
    {"\xC2\xB5", "u"},
    {"\xCE\xBC", "u"},
    {"\xC2\xB0", "deg"},
    {"\xE2\x81\xBB", "-"},
    {"\xB2", "2"},  // Latin-1
    {"\xB7", ""},
    {"\xB5", "u"},
    {"\xB0", "deg"},
    {"**2", "2"},
    {"^", ""},
    {"*", ""},
    {".", ""},
    {" ", ""},
};

std::string_view without_brackets(std::string_view text) {
  text = said_in(text);
  while (text.size() >= 2 && text.front() == '(' && text.find(')') == text.size() - 1) {
    text = said_in(text.substr(1, text.size() - 2));
  }
  return text;
}

std::string plain(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    std::size_t taken = 1;
    std::string_view put = text.substr(0, 1);
    for (const auto& [from, to] : replacements) {
      if (!text.starts_with(from)) continue;
      taken = from.size();
      put = to;
      break;
    }
    out += put;
    text.remove_prefix(taken);
  }
  return out;
}

std::optional<UnitRatio> ratio_of(std::string_view over, std::string_view under) {
  const std::optional<SiUnit> response = si_unit(over);
  const std::optional<SiUnit> excitation = si_unit(under);
  if (!response || !excitation) return std::nullopt;
  return UnitRatio{*response, *excitation};
}

}  // namespace

std::string_view said_in(std::string_view field) {
  constexpr std::string_view blanks(" \t\r\n\0", 5);
  const std::size_t first = field.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  field = field.substr(first, field.find_last_not_of(blanks) - first + 1);
  return field == "NONE" ? std::string_view() : field;
}

std::optional<SiUnit> si_unit(std::string_view text) {
  text = without_brackets(text);
  if (text.empty() || text.size() > 40) return std::nullopt;
  const std::string spelt = plain(text);
  for (const Spelling& spelling : spellings) {
    if (spelling.text == spelt) return SiUnit{std::string(spelling.symbol), spelling.factor};
  }
  return std::nullopt;
}

std::optional<UnitRatio> unit_ratio(std::string_view text) {
  text = said_in(text);
  if (text.starts_with("(1/")) {
    const std::size_t end = text.find(')');
    if (end == std::string_view::npos) return std::nullopt;
    std::string_view rest = said_in(text.substr(end + 1));
    if (!rest.starts_with('*')) return std::nullopt;
    return ratio_of(rest.substr(1), text.substr(3, end - 3));
  }
  // "m/s^2/N": the last stroke parts response and excitation.
  const std::size_t stroke = text.rfind('/');
  if (stroke == std::string_view::npos) return std::nullopt;
  return ratio_of(text.substr(0, stroke), text.substr(stroke + 1));
}

}  // namespace rvbench::hal::formats
