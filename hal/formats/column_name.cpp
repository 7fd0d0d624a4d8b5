#include "hal/formats/column_name.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include "hal/formats/si_unit.hpp"

namespace rvbench::hal::formats {
namespace {

// Units that mean something else behind an underscore: inner, radial, milli- and microseconds of a
// name.
constexpr std::array<std::string_view, 13> words = {"in",  "ft",  "mil", "lb", "lbs", "kp", "bar",
                                                    "rad", "deg", "sec", "ms", "us",  "ns"};

bool is_index(std::string_view text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_axis(std::string_view text) {
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  return text.size() == 1 && std::string_view("xyzXYZ").find(text.front()) != text.npos;
}

// The one unit of one letter that no name ends in.
bool is_gravity(std::string_view unit) { return unit == "g" || unit == "G"; }

// In round brackets stands as often what the column is: (A) axial, (V) vertical, (N) for number.
bool is_surely_unit(std::string_view unit) {
  return (unit.size() > 1 || is_gravity(unit)) && si_unit(unit);
}

bool is_no_word(std::string_view unit) {
  return (unit.size() > 1 || is_gravity(unit)) && std::ranges::find(words, unit) == words.end();
}

// "a / g", "a, g": the mark before a unit is no part of the name.
ColumnName behind_mark(std::string_view head) {
  for (const std::string_view mark : {" / ", ", "}) {
    const std::size_t before = head.rfind(mark);
    if (before == head.npos || before == 0) continue;
    const std::string_view unit = said_in(head.substr(before + mark.size()));
    if (unit.find(' ') == unit.npos && is_surely_unit(unit)) {
      return {std::string(said_in(head.substr(0, before))), std::string(unit)};
    }
  }
  return {"", ""};
}

ColumnName with_suffix(std::string_view head) {
  if (ColumnName found = behind_mark(head); !found.unit.empty()) return found;
  const std::size_t before = head.find_last_of("_ ");
  const std::string_view unit = before == head.npos ? "" : head.substr(before + 1);
  const bool is_unit = is_no_word(unit) && si_unit(unit);
  return {std::string(head), is_unit ? std::string(unit) : ""};
}

}  // namespace

ColumnName column_name(std::string_view head) {
  const bool square = head.ends_with(']');
  if (!square && !head.ends_with(')')) return with_suffix(head);
  const std::size_t before = head.find_last_of(square ? '[' : '(');
  const std::size_t after = head.size() - 1;
  if (before == head.npos) return {std::string(head), ""};
  const std::string_view unit = said_in(head.substr(before + 1, after - before - 1));
  const std::string_view name = said_in(head.substr(0, before));
  const bool is_unit = square ? !is_index(unit) && !is_axis(unit) : is_surely_unit(unit);
  if (!is_unit || name.empty()) return {std::string(head), is_unit ? std::string(unit) : ""};
  return {std::string(name), std::string(unit)};
}

std::string name_in_unit(const std::string& name, std::string_view symbol) {
  const ColumnName head = column_name(name);
  const std::optional<SiUnit> si = si_unit(head.unit);
  if (!si || si->symbol != symbol || si->factor == 1) return name;
  if (head.name != name) return head.name;
  if (!name.ends_with(head.unit)) return name;
  const std::string_view whole = name;
  const std::string_view rest = said_in(whole.substr(0, whole.size() - head.unit.size() - 1));
  return rest.empty() ? name : std::string(rest);
}

}  // namespace rvbench::hal::formats
