#include "hal/formats/table/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/utf16.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::string_view utf8_mark = "\xEF\xBB\xBF";
constexpr std::string_view little_mark = "\xFF\xFE";
constexpr std::string_view big_mark = "\xFE\xFF";

// Without a byte order mark the null bytes of its ASCII characters show UTF-16.
std::optional<std::endian> utf16_order(std::string_view text) {
  if (text.starts_with(little_mark)) return std::endian::little;
  if (text.starts_with(big_mark)) return std::endian::big;
  const std::string_view head = text.substr(0, 64);
  if (head.size() < 4 || head.size() % 2 != 0) return std::nullopt;
  std::size_t even = 0, odd = 0;
  for (std::size_t i = 0; i + 1 < head.size(); i += 2) {
    even += head[i] == '\0' ? 1 : 0;
    odd += head[i + 1] == '\0' ? 1 : 0;
  }
  if (even == 0 && odd == head.size() / 2) return std::endian::little;
  if (odd == 0 && even == head.size() / 2) return std::endian::big;
  return std::nullopt;
}

std::string from_utf16(std::string_view bytes, std::endian order) {
  if (bytes.starts_with(little_mark) || bytes.starts_with(big_mark)) bytes.remove_prefix(2);
  std::vector<std::uint16_t> units(bytes.size() / 2);
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto first = static_cast<std::uint8_t>(bytes[2 * i]);
    const auto second = static_cast<std::uint8_t>(bytes[2 * i + 1]);
    units[i] = static_cast<std::uint16_t>(order == std::endian::little ? first | second << 8
                                                                       : first << 8 | second);
  }
  return utf8_of(units);
}

}  // namespace

bool is_text(std::string_view head) {
  if (utf16_order(head)) return true;
  return std::ranges::all_of(head, [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\r' || c == '\t';
  });
}

Result<std::string> text_of(const std::filesystem::path& file) {
  std::string text = bytes_of(file);
  if (const auto order = utf16_order(text)) text = from_utf16(text, *order);
  if (text.starts_with(utf8_mark)) text.erase(0, utf8_mark.size());
  const std::size_t null = text.find('\0');
  if (null == text.npos) return text;
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(null), '\n');
  return bad_file(file, fmt::format("{}: not text: a null byte", line));
}

bool Lines::next() {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line_ = rest_.substr(0, end);
  rest_.remove_prefix(end);
  rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : rest_.empty() ? 0 : 1);
  ++number_;
  return true;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == line.npos; }

}  // namespace rvbench::hal::formats
