#pragma once

#include <string>

namespace rvbench::bench {

/// Letters of ASCII in lower case, all else as it is.
std::string lower_case(std::string text);

}  // namespace rvbench::bench
