#pragma once

#include <string>
#include <string_view>

namespace rvbench::bench {

/// `text` for an XML or HTML text or attribute: markup as entities, and U+FFFD for what XML 1.0
/// forbids (section 2.2: controls but tab, line feed and return, U+FFFE, U+FFFF) and for each byte
/// that is not UTF-8.
std::string xml_escaped(std::string_view text);

}  // namespace rvbench::bench
