#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rvbench::bench {

/// "none", "mod10", "mod43", "mod11_2".
const std::vector<std::string_view>& check_digit_schemes();

/// Whether the last character of a serial number checks those before it. Characters that the scheme
/// does not know make it wrong; '-', ' ', '.' and '/' part groups and do not count, where the
/// scheme does not count them itself.
///
/// Source  mod10: ISO/IEC 7812-1, annex B (Luhn); mod43: ISO/IEC 16388, Code 39's optional check;
///         mod11_2: ISO/IEC 7064, MOD 11-2, as of ISNI and ORCID
/// @throws std::invalid_argument: no scheme of that name
bool has_right_check_digit(std::string_view scheme, std::string_view serial);

}  // namespace rvbench::bench
