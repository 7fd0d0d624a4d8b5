#include "hal/can/dbc_tokens.hpp"

#include <algorithm>

namespace rvbench::hal::dbc {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

// A sign belongs to the number that follows it, as in -1.5, else it is a word of its own.
bool begins_number(std::string_view text, std::size_t at) {
  if (is_digit(text[at])) return true;
  const bool is_sign = text[at] == '-' || text[at] == '+';
  return is_sign && at + 1 < text.size() && (is_digit(text[at + 1]) || text[at + 1] == '.');
}

// Where the word or number that begins at `at` ends; a sign after an e is part of a number.
std::size_t end_of_word(std::string_view text, std::size_t at) {
  const bool is_number = begins_number(text, at);
  if (!is_number && is_separator(text[at])) return at + 1;
  std::size_t end = at + 1;
  for (; end < text.size() && !is_space(text[end]) && text[end] != '"'; ++end) {
    const bool after_e = is_number && (text[end - 1] == 'e' || text[end - 1] == 'E');
    const bool is_sign = text[end] == '-' || text[end] == '+';
    if (is_separator(text[end]) && !(after_e && is_sign)) break;
  }
  return end;
}

// Where the closing quote of a text is that begins at `at`.
std::size_t end_of_quoted(std::string_view text, std::size_t at, int line) {
  std::size_t end = at + 1;
  while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
  if (end >= text.size()) throw Refused(line, "a text without an end");
  return end;
}

}  // namespace

bool is_separator(char c) {
  return std::string_view(":|@+-()[],;").find(c) != std::string_view::npos;
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  Token next{.is_first = true, .starts_line = true};
  for (std::size_t at = 0; at < text.size();) {
    if (is_space(text[at])) {
      next.starts_line = text[at] == '\n';
      if (text[at] == '\n') next.is_first = true;
      next.line += text[at] == '\n' ? 1 : 0;
      ++at;
      continue;
    }
    next.is_string = text[at] == '"';
    const std::size_t begin = at + (next.is_string ? 1 : 0);
    const std::size_t end =
        next.is_string ? end_of_quoted(text, at, next.line) : end_of_word(text, at);
    next.text = text.substr(begin, end - begin);
    tokens.push_back(next);
    next.line += static_cast<int>(std::ranges::count(next.text, '\n'));
    next.is_first = next.starts_line = false;
    at = end + (next.is_string ? 1 : 0);
  }
  return tokens;
}

}  // namespace rvbench::hal::dbc
