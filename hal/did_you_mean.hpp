#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rvbench::hal {

/// `, did you mean "speeds_rpm"?`, or nothing if no word is near to the wrong one.
std::string did_you_mean(std::string_view wrong, const std::vector<std::string>& words);

/// "quick, rv20e_acceptance"
std::string listed(const std::vector<std::string>& names);

/// ` (there are: quick, rv20e_acceptance), did you mean "quick"?`
std::string what_there_is(std::string_view wrong, const std::vector<std::string>& names);

/// In quotes, cut short and with control characters escaped: fit for a terminal.
std::string in_quotes(std::string_view text);

}  // namespace rvbench::hal
