#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// Whether the first bytes of a file are text: ASCII, UTF-8, Latin-1, or UTF-16.
bool is_text(std::string_view head);

/// A text file as UTF-8, without a byte order mark. Latin-1 stays as it is.
/// Errors  bad_data: a null byte, with its line
Result<std::string> text_of(const std::filesystem::path& file);

/// The lines of a text, one after the other, without their ends: "\n", "\r\n" or "\r".
class Lines {
 public:
  explicit Lines(std::string_view text) : rest_(text) {}

  bool next();
  std::string_view line() const { return line_; }
  std::size_t number() const { return number_; }  ///< of the line, from 1

 private:
  std::string_view rest_, line_;
  std::size_t number_ = 0;
};

bool is_blank(std::string_view line);

/// With letters of ASCII in lower case.
std::string lower_case(std::string_view text);

}  // namespace rvbench::hal::formats
