#include "bench/serve/serial_rule.hpp"

#include <algorithm>

#include "bench/serve/check_digit.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_serial = 64;

bool is_printable(char c) { return c >= ' ' && c <= '~'; }

bool fits(char mask, char c) {
  const bool is_digit = c >= '0' && c <= '9';
  const bool is_letter = c >= 'A' && c <= 'Z';
  switch (mask) {
    case '#': return is_digit;
    case '@': return is_letter;
    case '*': return is_digit || is_letter;
    default: return c == mask;
  }
}

}  // namespace

bool fits_mask(std::string_view mask, std::string_view serial) {
  return std::ranges::equal(mask, serial, fits);
}

std::string scanned_serial(std::string_view text) {
  constexpr std::string_view around = " \t\r\n";
  const std::size_t first = text.find_first_not_of(around);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(around) - first + 1));
}

std::string serial_fault(const SerialRule& rule, std::string_view serial) {
  if (serial.empty()) return "empty";
  if (serial.size() > longest_serial || !std::ranges::all_of(serial, is_printable)) {
    return "serial_rule";
  }
  const auto fits_it = [serial](const std::string& mask) { return fits_mask(mask, serial); };
  if (!rule.masks.empty() && !std::ranges::any_of(rule.masks, fits_it)) return "serial_rule";
  return has_right_check_digit(rule.check_digit, serial) ? "" : "check_digit";
}

}  // namespace rvbench::bench
