#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

namespace rvbench::bench {

/// "runs/A17: Read-only file system": what the system says, without the words of the library.
std::string reason_of(const std::system_error& error);

/// Replaces the file in one step: after a crash it holds the old text or the new one, after this
/// has returned the new one. If that fails, no draft is left behind. Of two that write at a time
/// one has the last word, whole. What is there and no regular file is left alone.
/// @throws std::system_error
void write_file(const std::filesystem::path& file, const std::string& text);

/// The file whose new text write_file() drafts, or has drafted, under that name; empty if under no
/// such. A kill may leave a draft there, which nobody writes to again.
std::filesystem::path drafted_file(const std::filesystem::path& draft);

/// The text of a regular file; nullopt if it is none or cannot be read.
std::optional<std::string> read_file(const std::filesystem::path& file);

}  // namespace rvbench::bench
