#pragma once

#include <filesystem>
#include <string>

namespace rvbench::bench {

/// "file://bench-3/srv/runs/A17/...": a file and the computer it is on. What may not stand in a
/// path of a URI is escaped by percent signs.
/// Source  RFC 8089 (the scheme), RFC 3986, 2.1 to 2.3 (escapes)
std::string file_uri(const std::filesystem::path& file);

}  // namespace rvbench::bench
