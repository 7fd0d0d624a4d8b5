#include "hal/formats/printable.hpp"

#include <algorithm>
#include <cstddef>

#include "hal/types/utf8.hpp"

namespace rvbench::hal::formats {
namespace {

bool is_control(char c) { return (c >= 0 && c < 0x20) || c == 0x7F; }

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t bytes = utf8_character_bytes(text, at);
    const bool shown = bytes > 0 && !is_control(text[at]);
    out += shown ? text.substr(at, bytes) : std::string_view("?");
    at += std::max<std::size_t>(bytes, 1);
  }
  return out;
}

}  // namespace rvbench::hal::formats
