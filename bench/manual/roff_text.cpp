#include "bench/manual/roff_text.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <sstream>

namespace rvbench::bench {
namespace {

constexpr std::size_t columns = 76;

// Of the character that begins at `at`, which is moved behind it. What is no UTF-8 counts as
// itself.
std::uint32_t code_point(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(at++);
  const std::size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : 0;
  std::uint32_t code = more == 0 ? first : first & (0x3FU >> more);
  for (std::size_t i = 0; i < more && at < text.size(); ++i)
    code = code << 6 | (byte(at++) & 0x3FU);
  return code;
}

// Source: groff_char(7), "Basic Latin": the characters that roff shows as others.
std::string shown(char c) {
  switch (c) {
    case '\\': return "\\e";
    case '-': return "\\-";
    case '\'': return "\\(aq";
    case '`': return "\\(ga";
    case '^': return "\\(ha";
    case '~': return "\\(ti";
    case '"': return "\\(dq";
    default: return {c};
  }
}

}  // namespace

std::string roff_text(std::string_view text) {
  std::string roff;
  bool begins_line = true;
  for (std::size_t at = 0; at < text.size();) {
    const std::uint32_t code = code_point(text, at);
    if (begins_line && code == '.') roff += "\\&";
    roff += code < 0x80 ? shown(static_cast<char>(code)) : fmt::format("\\[u{:04X}]", code);
    begins_line = code == '\n';
  }
  return roff;
}

std::string roff_paragraph(std::string_view text) {
  std::string lines;
  std::size_t used = 0;
  std::istringstream words{std::string(text)};
  for (std::string word; words >> word;) {
    const std::string roff = used == 0 ? roff_text(word) : roff_text(' ' + word).substr(1);
    if (used > 0 && used + 1 + roff.size() > columns) {
      lines += '\n' + roff_text(word);
      used = roff.size();
    } else {
      lines += (used > 0 ? " " : "") + roff;
      used += roff.size() + 1;
    }
  }
  return lines + '\n';
}

}  // namespace rvbench::bench
