#include "hal/formats/utf16.hpp"

#include <algorithm>

#include "hal/types/utf8.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::uint32_t first_beyond = 0x10000, high = 0xD800, low = 0xDC00, after = 0xE000;

std::uint32_t bits(char c, unsigned mask) { return static_cast<unsigned char>(c) & mask; }

// The code point of one sound UTF-8 character.
std::uint32_t code_point(std::string_view character) {
  constexpr unsigned first_masks[] = {0x7F, 0x1F, 0x0F, 0x07};
  std::uint32_t code = bits(character.front(), first_masks[character.size() - 1]);
  for (const char c : character.substr(1)) code = code << 6U | bits(c, 0x3F);
  return code;
}

void append(std::string& text, std::uint32_t code) {
  const auto put = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0U | code >> 6U);
  } else {
    if (code < first_beyond) {
      put(0xE0U | code >> 12U);
    } else {
      put(0xF0U | code >> 18U);
      put(0x80U | (code >> 12U & 0x3FU));
    }
    put(0x80U | (code >> 6U & 0x3FU));
  }
  put(0x80U | (code & 0x3FU));
}

}  // namespace

std::vector<std::uint16_t> utf16_of(std::string_view text) {
  std::vector<std::uint16_t> units;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_character_bytes(text, at);
    const std::uint32_t code = bytes == 0 ? '?' : code_point(text.substr(at, bytes));
    at += std::max<std::size_t>(bytes, 1);
    if (code < first_beyond) {
      units.push_back(static_cast<std::uint16_t>(code));
    } else {
      units.push_back(static_cast<std::uint16_t>(high + ((code - first_beyond) >> 10U)));
      units.push_back(static_cast<std::uint16_t>(low + ((code - first_beyond) & 0x3FFU)));
    }
  }
  return units;
}

std::string utf8_of(std::span<const std::uint16_t> units) {
  std::string text;
  for (std::size_t i = 0; i < units.size(); ++i) {
    const std::uint32_t unit = units[i];
    const bool is_pair = unit >= high && unit < low && i + 1 < units.size() &&
                         units[i + 1] >= low && units[i + 1] < after;
    if (is_pair) {
      append(text, first_beyond + ((unit - high) << 10U) + (units[++i] - low));
    } else {
      append(text, unit >= high && unit < after ? '?' : unit);
    }
  }
  return text;
}

}  // namespace rvbench::hal::formats
