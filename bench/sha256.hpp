#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rvbench::bench {

/// 64 lower-case hex digits.
std::string sha256_of_text(const std::string& text);
std::optional<std::string> sha256_of_file(
    const std::filesystem::path& file);  ///< nullopt: unreadable

/// Writes SHA256SUMS over every other file of the folder; `sha256sum -c SHA256SUMS` reads it. All
/// of them are on the disk first: a power failure must not make sums wrong that were right.
/// @throws std::system_error
void write_sums(const std::filesystem::path& folder);

/// Puts the sums of these files of the folder in place of those they had, or beside the others,
/// which stay as they are: no hash of a file that nobody wrote is made anew.
/// @throws std::system_error
void renew_sums(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Whether write_sums() has come to its end there, since remove_sums().
bool has_sums(const std::filesystem::path& folder);

/// Before a folder's files change. @throws std::system_error
void remove_sums(const std::filesystem::path& folder);

/// Whether that file of the folder is as its line in SHA256SUMS says.
bool matches_sum(const std::filesystem::path& folder, const std::string& name);

/// What is wrong with a folder and its SHA256SUMS: "recording.h5: does not match its hash".
/// Empty if every file listed is there unchanged and none is unlisted.
std::vector<std::string> verify_sums(const std::filesystem::path& folder);

}  // namespace rvbench::bench
