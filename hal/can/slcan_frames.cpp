#include "hal/can/slcan_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <utility>

namespace rvbench::hal::slcan_frames {
namespace {

constexpr std::size_t longest_line = 64;  // "T", 8 + 1 + 16 digits and a time stamp are 30
constexpr std::size_t time_stamp_digits = 4;
constexpr std::array bitrates_kbit_s{10, 20, 50, 100, 125, 250, 500, 800, 1000};  // S0 to S8

// Nothing unless all of it is digits.
std::optional<std::uint32_t> hex_from(std::string_view digits) {
  std::uint32_t value = 0;
  for (const char c : digits) {
    const bool is_letter = (c >= 'A' && c <= 'F') || (c >= 'a' && c <= 'f');
    if (!is_letter && !(c >= '0' && c <= '9')) return std::nullopt;
    const int digit = is_letter ? (c | 0x20) - 'a' + 10 : c - '0';
    value = 16 * value + static_cast<std::uint32_t>(digit);
  }
  return value;
}

Line frame_from(std::string_view text) {
  const bool is_extended = text[0] == 'T' || text[0] == 'R';
  const bool has_data = text[0] == 't' || text[0] == 'T';
  const std::size_t at_length = is_extended ? 9 : 4;
  if (text.size() <= at_length) return {};
  const auto id = hex_from(text.substr(1, at_length - 1));
  const int length = text[at_length] - '0';
  if (!id || *id > (is_extended ? 0x1FFFFFFFu : 0x7FFu) || length < 0 || length > 8) return {};
  std::string_view rest = text.substr(at_length + 1);
  const auto count = has_data ? static_cast<std::size_t>(length) : 0;
  if (rest.size() != 2 * count && rest.size() != 2 * count + time_stamp_digits) return {};
  Line line{LineKind::frame, {.id = *id, .length = static_cast<std::uint8_t>(length)}};
  for (std::size_t i = 0; i < count; ++i, rest.remove_prefix(2)) {
    const auto byte = hex_from(rest.substr(0, 2));
    if (!byte) return {};
    line.frame.data[i] = static_cast<std::uint8_t>(*byte);
  }
  if (!hex_from(rest)) return {};
  return is_extended || !has_data ? Line{LineKind::other_frame} : line;
}

Line flags_from(std::string_view text) {
  const auto flags = text.size() == 3 ? hex_from(text.substr(1)) : std::nullopt;
  return flags ? Line{LineKind::flags, {}, *flags} : Line{};
}

Line state_from(std::string_view text) {
  constexpr std::string_view digits = "0123456789";
  if (text.size() != 8 || text.find_first_not_of(digits, 2) != std::string_view::npos) return {};
  switch (text[1]) {
    case 'a': return {LineKind::remark, {}, 0};
    case 'w': return {LineKind::remark, {}, error_warning};
    case 'p': return {LineKind::remark, {}, error_passive};
    case 'b': return {LineKind::remark, {}, bus_off};
    default: return {};
  }
}

Line errors_from(std::string_view text) {
  if (text.size() < 3 || text[1] < '1' || text[1] > '8') return {};
  const std::string_view errors = text.substr(2);
  if (errors.size() != static_cast<std::size_t>(text[1] - '0')) return {};
  if (errors.find_first_not_of("abBcfoOs") != std::string_view::npos) return {};
  unsigned flags = bus_error;
  if (errors.find('o') != std::string_view::npos) flags |= data_overrun;
  if (errors.find('O') != std::string_view::npos) flags |= send_queue_full;
  return {LineKind::remark, {}, flags};
}

bool is_text(std::string_view text) {
  return std::ranges::all_of(text, [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace

Line line_from(std::string_view text) {
  if (text.empty()) return {LineKind::done};
  switch (text[0]) {
    case 't':
    case 'T':
    case 'r':
    case 'R': return frame_from(text);
    case 'z':
    case 'Z': return text.size() == 1 ? Line{LineKind::sent} : Line{};
    case 'F': return flags_from(text);
    case 's': return state_from(text);
    case 'e': return errors_from(text);
    case 'V':
    case 'N': return is_text(text) ? Line{LineKind::version} : Line{};
    default: return {};
  }
}

void LineReader::add(std::string_view bytes) { bytes_.append(bytes); }

std::optional<Line> LineReader::next() {
  const std::size_t end = bytes_.find_first_of("\r\a", from_);
  if (end == std::string::npos) {
    bytes_.erase(0, from_);
    from_ = 0;
    if (bytes_.size() > longest_line) is_overlong_ = true;
    if (is_overlong_) bytes_.clear();
    return std::nullopt;
  }
  const std::string_view text = std::string_view(bytes_).substr(from_, end - from_);
  const bool is_bell = bytes_[end] == '\a';
  const bool is_garbled = std::exchange(is_overlong_, false) || text.size() > longest_line ||
                          (is_bell && !text.empty());
  // A BEL behind rubbish is still a line of its own.
  from_ = is_bell && is_garbled ? end : end + 1;
  if (is_garbled) return Line{};
  return is_bell ? Line{LineKind::declined} : line_from(text);
}

void LineReader::clear() {
  bytes_.clear();
  from_ = 0;
  is_overlong_ = false;
}

std::string command_from(const CanFrame& frame) {
  if (frame.id > 0x7FF || frame.length > frame.data.size()) {
    throw std::invalid_argument(
        fmt::format("slcan_frames::command_from: identifier 0x{:X} with {} bytes, at most 0x7FF "
                    "and 8",
                    frame.id, frame.length));
  }
  std::string command = fmt::format("t{:03X}{}", frame.id, frame.length);
  for (std::size_t i = 0; i < frame.length; ++i) command += fmt::format("{:02X}", frame.data[i]);
  return command + '\r';
}

std::optional<std::string> command_from_bitrate(int bitrate_kbit_s) {
  const auto found = std::ranges::find(bitrates_kbit_s, bitrate_kbit_s);
  if (found == bitrates_kbit_s.end()) return std::nullopt;
  return fmt::format("S{}\r", found - bitrates_kbit_s.begin());
}

}  // namespace rvbench::hal::slcan_frames
