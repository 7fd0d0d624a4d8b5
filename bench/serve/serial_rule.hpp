#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rvbench::bench {

/// What serial numbers of a station look like.
///
/// A mask has as many characters as the serial number: '#' stands for a digit, '@' for a capital
/// letter, '*' for either; every other character for itself. No mask takes longer to compare than
/// the serial number is long, which cannot be said of regular expressions.
struct SerialRule {
  std::vector<std::string> masks = {};  ///< one of them must fit; empty: whatever can be printed
  std::string check_digit = "none";     ///< one of check_digit_schemes()
};

bool fits_mask(std::string_view mask, std::string_view serial);

/// What a scanner sends, without the blanks and line ends around it.
std::string scanned_serial(std::string_view text);

/// "" if it is one, else "empty", "serial_rule" or "check_digit". At most 64 printable characters
/// of ASCII are a serial number by any rule.
std::string serial_fault(const SerialRule& rule, std::string_view serial);

}  // namespace rvbench::bench
