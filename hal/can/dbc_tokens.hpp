#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace rvbench::hal::dbc {

/// A word, number, separator or text of a DBC file.
struct Token {
  std::string_view text = {};
  int line = 1;
  bool is_string = false;
  bool is_first = false;     ///< of its line
  bool starts_line = false;  ///< and no space before it: a new section
};

/// What is wrong with a file, and in which line.
struct Refused : std::runtime_error {
  Refused(int at, const std::string& what) : std::runtime_error(what), line(at) {}
  int line;
};

bool is_separator(char c);

/// @throws Refused if a text has no end
std::vector<Token> tokens_of(std::string_view text);

}  // namespace rvbench::hal::dbc
