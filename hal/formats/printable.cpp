#include "hal/formats/printable.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "hal/types/utf8.hpp"

namespace rvbench::hal::formats {
namespace {

bool is_control(char c) { return (c >= 0 && c < 0x20) || c == 0x7F; }

bool make_printable(std::string& text) {
  std::string shown = printable(text);
  const bool was_not = shown != text;
  text = std::move(shown);
  return was_not;
}

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

bool has_control_character(std::string_view text) { return std::ranges::any_of(text, is_control); }

bool make_printable(Recording& recording) {
  bool was_not = make_printable(recording.status);
  for (Channel& channel : recording.channels) {
    for (std::string* text : {&channel.info.name, &channel.info.unit, &channel.info.direction}) {
      was_not = make_printable(*text) || was_not;
    }
  }
  for (std::string& note : recording.notes) was_not = make_printable(note) || was_not;
  return was_not;
}

}  // namespace rvbench::hal::formats
