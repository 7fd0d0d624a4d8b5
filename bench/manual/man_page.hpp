#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/command.hpp"

namespace rvbench::bench {

/// The manual page rvbench(1), made of what the commands say of themselves, as --help is.
/// @param version  of the software, in the page's foot
/// @param date     likewise, YYYY-MM-DD
/// @return         source for man(1): groff_man(7)
std::string man_page(const std::vector<std::unique_ptr<Command>>& commands,
                     const std::string& version, const std::string& date);

}  // namespace rvbench::bench
