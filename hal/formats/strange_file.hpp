#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rvbench::hal::formats {

/// What a file looks like that rvbench does not read, and the way round: "a ZIP archive or a
/// workbook of Excel: save the table as CSV". Nothing if its first bytes tell nothing of the kind.
/// Errors  none thrown: of a file that cannot be read nothing is told
std::optional<std::string> what_it_looks_like(const std::filesystem::path& file);

/// "no file that rvbench reads (it looks like ...)"
std::string not_read(const std::string& looks_like);

}  // namespace rvbench::hal::formats
