#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace rvbench::bench {

/// "runs/A17: Read-only file system": what the system says, without the words of the library.
std::string reason_of(const std::system_error& error);

/// Replaces the file in one step: after a crash it holds the old text or the new one, after this
/// has returned the new one. If that fails, no draft is left behind.
/// @throws std::system_error
void write_file(const std::filesystem::path& file, const std::string& text);

/// Where write_file() drafts the new text. A kill may leave it there.
std::filesystem::path draft_of(const std::filesystem::path& file);

/// The text of a regular file; nullopt if it is none or cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& file);

}  // namespace rvbench::bench
