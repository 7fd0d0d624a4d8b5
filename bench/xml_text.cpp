#include "bench/xml_text.hpp"

#include <algorithm>
#include <cstddef>

#include "hal/types/utf8.hpp"

namespace rvbench::bench {
namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";

// Of whole UTF-8 characters: what is no character at all is not asked about.
bool is_forbidden(std::string_view character) {
  const char c = character.front();
  if (character.size() == 1) return c < 0x20 && c != '\t' && c != '\n' && c != '\r';
  return character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF";
}

std::string_view escaped(std::string_view character) {
  if (character.empty() || is_forbidden(character)) return replacement;
  switch (character.front()) {
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '&': return "&amp;";
    case '"': return "&quot;";
    default: return character;
  }
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string xml;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_character_bytes(text, at);
    xml += escaped(text.substr(at, bytes));
    at += std::max<std::size_t>(bytes, 1);
  }
  return xml;
}

}  // namespace rvbench::bench
