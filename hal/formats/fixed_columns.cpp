#include "hal/formats/fixed_columns.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "hal/formats/si_unit.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::string_view blanks = " \t\r\n";
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::size_t digits_at(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && is_digit(text[end])) ++end;
  return end - at;
}

bool is_sign(std::string_view text, std::size_t at) {
  return at < text.size() && (text[at] == '+' || text[at] == '-');
}

// Length of the exponent at `at`, with its letter; 0 if there is none. FORTRAN leaves the letter
// out where the exponent has three digits.
std::size_t exponent_length(std::string_view text, std::size_t at) {
  constexpr std::string_view letters = "EeDd";
  const bool letter = at < text.size() && letters.find(text[at]) != std::string_view::npos;
  const std::size_t sign = at + (letter ? 1 : 0);
  const bool is_signed = is_sign(text, sign);
  const std::size_t digits = digits_at(text, sign + (is_signed ? 1 : 0));
  const std::size_t length = (letter ? 1 : 0) + (is_signed ? 1U : 0U) + digits;
  if (letter) return digits > 0 ? length : 0;
  const bool goes_on = at + length < text.size() && text[at + length] == '.';
  return is_signed && digits == 3 && !goes_on ? length : 0;
}

// Words for what is no number, in the ways that C, MATLAB and FORTRAN write them.
std::size_t word_length(std::string_view text) {
  constexpr std::array<std::string_view, 7> words = {"NaN",      "nan", "NAN", "Infinity",
                                                     "infinity", "Inf", "inf"};
  for (const std::string_view word : words) {
    if (text.starts_with(word)) return word.size();
  }
  return 0;
}

// `digits`: "1.5"; `exponent`: "", "D+03", "-101"
std::optional<double> value_of(std::string_view digits, std::string_view exponent) {
  constexpr std::size_t longest = 60;
  if (digits.size() + exponent.size() > longest) return std::nullopt;
  std::array<char, longest + 1> text{};
  std::size_t size = digits.copy(text.data(), digits.size());
  if (!exponent.empty()) {
    text[size++] = 'e';
    if (!is_sign(exponent, 0)) exponent.remove_prefix(1);
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    size += exponent.copy(text.data() + size, exponent.size());
  }
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + size, value);
  if (end != text.data() + size) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    return exponent.starts_with('-') ? 0.0 : nan;  // too small, or as good as infinite
  }
  return error == std::errc() ? std::optional<double>(value) : std::nullopt;
}

}  // namespace

std::optional<double> take_fortran_number(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::size_t start = is_sign(text, 0) ? 1 : 0;
  if (const std::size_t word = word_length(text.substr(start)); word > 0) {
    text.remove_prefix(start + word);
    return nan;
  }
  std::size_t end = start + digits_at(text, start);
  std::size_t digits = end - start;
  if (end < text.size() && text[end] == '.') {
    const std::size_t behind = digits_at(text, end + 1);
    digits += behind;
    end += 1 + behind;
  }
  if (digits == 0) return std::nullopt;
  const std::size_t exponent = exponent_length(text, end);
  const std::optional<double> value =
      value_of(text.substr(start, end - start), text.substr(end, exponent));
  if (!value) return std::nullopt;
  const bool negative = text.starts_with('-');
  text.remove_prefix(end + exponent);
  return negative ? -*value : *value;
}

std::optional<int> Columns::integer() const {
  std::string_view digits = said_in(text_);
  if (digits.empty()) return 0;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
  return value;
}

std::optional<double> Columns::number() const {
  std::string_view rest = said_in(text_);
  if (rest.empty()) return 0;
  const std::optional<double> value = take_fortran_number(rest);
  return value && rest.empty() ? value : std::nullopt;
}

}  // namespace rvbench::hal::formats
