#include "hal/formats/table/number_marks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "hal/formats/table/text.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::size_t longest_number = 60;

bool is_decimal_digit(char c) { return c >= '0' && c <= '9'; }

std::string_view unsigned_part(std::string_view cell) {
  if (cell.starts_with('+') || cell.starts_with('-')) cell.remove_prefix(1);
  return cell;
}

// "1,234,567": one to three digits without a leading zero, then groups of three.
bool is_grouped(std::string_view whole, char mark) {
  std::size_t end = whole.find(mark);
  if (end == whole.npos || end == 0 || end > 3 || whole.front() == '0') return false;
  if (!std::ranges::all_of(whole.substr(0, end), is_decimal_digit)) return false;
  while (end < whole.size()) {
    const std::string_view group = whole.substr(end + 1, 3);
    if (whole[end] != mark || group.size() < 3 || !std::ranges::all_of(group, is_decimal_digit)) {
      return false;
    }
    end += 4;
  }
  return true;
}

// Whether `mark` parts thousands in a cell whose decimal mark, if it has one, is `decimal`.
bool may_group(std::string_view cell, char mark, char decimal) {
  const std::string_view digits = unsigned_part(cell);
  const std::string_view whole = digits.substr(0, digits.find(decimal));
  return is_grouped(whole, mark) && digits.substr(whole.size()).find(mark) == digits.npos;
}

}  // namespace

bool is_lost(std::string_view cell) {
  constexpr std::array<std::string_view, 15> words = {"",     "na",   "n/a",  "#n/a", "nan",
                                                      "-nan", "+nan", "null", "none", "-",
                                                      "--",   "---",  "inf",  "+inf", "-inf"};
  if (cell.size() > 4) return false;
  return std::ranges::find(words, lower_case(cell)) != words.end();
}

bool may_be_number(std::string_view cell) {
  const std::string_view digits = unsigned_part(cell);
  if (digits.empty() || digits.size() > longest_number) return false;
  if (!is_decimal_digit(digits.front()) && (digits.size() < 2 || !is_decimal_digit(digits[1])))
    return false;
  bool has_exponent = false;
  char before = ' ';
  for (const char c : digits) {
    const bool is_sign = (c == '+' || c == '-') && (before == 'e' || before == 'E');
    const bool is_exponent = (c == 'e' || c == 'E') && !has_exponent;
    if (!is_decimal_digit(c) && c != '.' && c != ',' && !is_sign && !is_exponent) return false;
    has_exponent = has_exponent || is_exponent;
    before = c;
  }
  return is_decimal_digit(digits.back()) || digits.back() == '.';
}

std::optional<double> written_number(std::string_view cell, NumberStyle style) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  std::array<char, longest_number> plain{};
  std::string_view digits = cell;
  if (style.decimal != '.' || style.thousands != '\0') {
    if (cell.size() > plain.size()) return std::nullopt;
    const bool grouped = style.thousands != '\0' && cell.find(style.thousands) != cell.npos;
    if (grouped && !may_group(cell, style.thousands, style.decimal)) return std::nullopt;
    std::size_t count = 0;
    for (const char c : cell) {
      if (grouped && c == style.thousands) continue;
      if (c == '.' && style.decimal != '.') return std::nullopt;
      plain[count++] = c == style.decimal ? '.' : c;
    }
    digits = {plain.data(), count};
  }
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number =
      error == std::errc() && end == digits.data() + digits.size() && !std::isinf(value);
  return is_number ? std::optional(value) : std::nullopt;
}

std::optional<double> number_in(std::string_view cell, NumberStyle style) {
  const std::optional<double> written = written_number(cell, style);
  return written || !is_lost(cell) ? written : not_known;
}

void NumberMarks::add(std::string_view cell, std::size_t line, std::size_t column) {
  const auto keep = [&](Place& place) {
    if (!place) place = {line, column, std::string(cell.substr(0, 40))};
  };
  if (column > columns_.size()) columns_.resize(column);
  const auto points = std::ranges::count(cell, '.'), commas = std::ranges::count(cell, ',');
  const auto look = [&](Mark& mark, long count, char own, char other) {
    if (count == 0) return;
    keep(mark.any);
    const bool groups = may_group(cell, own, other);
    keep(groups ? mark.grouping : mark.decimal);
    if (count > 1) keep(mark.several);
    if (own == ',' && groups) keep(columns_[column - 1].grouping);
  };
  look(points_, points, '.', ',');
  look(commas_, commas, ',', '.');
  const bool is_small = points == 0 && commas == 0 && unsigned_part(cell).size() <= 3;
  if (is_small && may_be_number(cell)) keep(columns_[column - 1].whole);
}

namespace {

template <typename Place>
std::string cell_text(const Place& place) {
  return fmt::format("\"{}\" ({}:{})", place.cell, place.line, place.column);
}

constexpr const char* way_round = ": state --decimal point or --decimal comma";

}  // namespace

NumberMarks::Answer NumberMarks::style(char separator, char decimal) const {
  if (decimal != '\0') return as_stated(decimal);
  if (points_.any && commas_.any) return with_both();
  if (commas_.any) return with_commas(separator);
  if (!points_.several) return NumberStyle{};
  if (!points_.decimal) return NumberStyle{',', '.'};
  return fmt::format("{} is not a number", cell_text(points_.several));
}

NumberMarks::Answer NumberMarks::with_commas(char separator) const {
  const Place& grouping = commas_.grouping;
  const Place& not_grouping = commas_.decimal;
  if (grouping && not_grouping && (separator == ',' || commas_.several)) {
    return fmt::format("the comma parts thousands in {} and decimals in {}, or decimals in both",
                       cell_text(grouping), cell_text(not_grouping)) +
           way_round;
  }
  if (commas_.several || (grouping && separator == ',')) return NumberStyle{'.', ','};
  if (not_grouping) return NumberStyle{',', '\0'};
  for (const Column& column : columns_) {
    if (!column.grouping || !column.whole) continue;
    return fmt::format("{} may be a thousand or more, or a decimal number, beside {}",
                       cell_text(column.grouping), cell_text(column.whole)) +
           way_round;
  }
  return NumberStyle{',', '\0'};
}

NumberMarks::Answer NumberMarks::with_both() const {
  const bool comma_groups = !commas_.decimal, point_groups = !points_.decimal;
  if (comma_groups && !point_groups) return NumberStyle{'.', ','};
  if (point_groups && !comma_groups) return NumberStyle{',', '.'};
  const Place& point = points_.decimal ? points_.decimal : points_.any;
  const Place& comma = commas_.decimal ? commas_.decimal : commas_.any;
  return fmt::format("{} has a decimal point, {} a decimal comma", cell_text(point),
                     cell_text(comma)) +
         (comma_groups ? way_round : "");
}

NumberMarks::Answer NumberMarks::as_stated(char decimal) const {
  const Mark& other = decimal == '.' ? commas_ : points_;
  const char mark = decimal == '.' ? ',' : '.';
  if (other.decimal) {
    return fmt::format("{} is not a number with a decimal {}", cell_text(other.decimal),
                       decimal == '.' ? "point" : "comma");
  }
  return NumberStyle{decimal, other.any ? mark : '\0'};
}

}  // namespace rvbench::hal::formats
