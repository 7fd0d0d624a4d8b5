#include "bench/serve/check_digit.hpp"

#include <stdexcept>

namespace rvbench::bench {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string without_gaps(std::string_view serial) {
  std::string kept;
  for (const char c : serial) {
    if (std::string_view("- ./").find(c) == std::string_view::npos) kept += c;
  }
  return kept;
}

// Every second digit from the right, beginning beside the check digit, counts twice.
bool is_mod10(const std::string& digits) {
  int sum = 0;
  bool twice = false;
  for (auto at = digits.rbegin(); at != digits.rend(); ++at, twice = !twice) {
    if (!is_digit(*at)) return false;
    const int value = (*at - '0') * (twice ? 2 : 1);
    sum += value / 10 + value % 10;
  }
  return digits.size() > 1 && sum % 10 == 0;
}

bool is_mod43(std::string_view text) {
  constexpr std::string_view values = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ-. $/+%";
  if (text.size() < 2) return false;
  std::size_t sum = 0;
  for (const char c : text.substr(0, text.size() - 1)) {
    const std::size_t value = values.find(c);
    if (value == std::string_view::npos) return false;
    sum += value;
  }
  return values[sum % values.size()] == text.back();
}

bool is_mod11_2(const std::string& text) {
  if (text.size() < 2) return false;
  int power = 0;
  for (const char c : text.substr(0, text.size() - 1)) {
    if (!is_digit(c)) return false;
    power = (power + c - '0') * 2 % 11;
  }
  const int check = (12 - power) % 11;
  return text.back() == (check == 10 ? 'X' : static_cast<char>('0' + check));
}

}  // namespace

const std::vector<std::string_view>& check_digit_schemes() {
  static const std::vector<std::string_view> schemes{"none", "mod10", "mod43", "mod11_2"};
  return schemes;
}

bool has_right_check_digit(std::string_view scheme, std::string_view serial) {
  if (scheme == "none") return true;
  if (scheme == "mod10") return is_mod10(without_gaps(serial));
  if (scheme == "mod43") return is_mod43(serial);
  if (scheme == "mod11_2") return is_mod11_2(without_gaps(serial));
  throw std::invalid_argument("has_right_check_digit: no scheme " + std::string(scheme));
}

}  // namespace rvbench::bench
