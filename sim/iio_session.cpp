#include "sim/iio_session.hpp"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <string_view>
#include <utility>
#include <vector>

namespace rvbench::sim {
namespace {

constexpr const char* id = "iio:device0";
constexpr double patience_s = 10;  // for scans; a client's own is shorter

std::string number(long value) { return std::to_string(value) + "\n"; }

std::string with_length(const std::string& text) { return number(long(text.size())) + text + "\n"; }

std::string decimal(double value) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9f", value);
  return text;
}

// The first word of a line, which is taken away.
std::string_view next_word(std::string_view& line) {
  const std::size_t from = std::min(line.find_first_not_of(' '), line.size());
  line.remove_prefix(from);
  const std::string_view word = line.substr(0, std::min(line.find(' '), line.size()));
  line.remove_prefix(word.size());
  return word;
}

template <typename T>
std::optional<T> parsed(std::string_view text, int base) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// Clients check a context against the elements that it may hold.
constexpr const char* elements =
    "<!DOCTYPE context ["
    "<!ELEMENT context (device)*><!ATTLIST context name CDATA #REQUIRED description CDATA #IMPLIED>"
    "<!ELEMENT device (channel | attribute)*>"
    "<!ATTLIST device id CDATA #REQUIRED name CDATA #IMPLIED>"
    "<!ELEMENT channel (scan-element?, attribute*)>"
    "<!ATTLIST channel id CDATA #REQUIRED type (input|output) #REQUIRED>"
    "<!ELEMENT scan-element EMPTY>"
    "<!ATTLIST scan-element index CDATA #REQUIRED format CDATA #REQUIRED scale CDATA #IMPLIED>"
    "<!ELEMENT attribute EMPTY>"
    "<!ATTLIST attribute name CDATA #REQUIRED filename CDATA #IMPLIED>]>";

std::string context_of(const IioFrontEnd& front_end) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"utf-8\"?>" + std::string(elements) +
                    "<context name=\"local\" "
                    "description=\"simulated bench\"><device id=\"" +
                    std::string(id) + "\" name=\"" + front_end.device + "\">";
  for (std::size_t i = 0; i < front_end.labels.size(); ++i) {
    const std::string n = std::to_string(i);
    xml += "<channel id=\"accel" + n + "\" type=\"input\"><scan-element index=\"" + n +
           "\" format=\"le:S32/32&gt;&gt;0\" scale=\"" + decimal(front_end.m_s2_per_count) +
           "\"/><attribute name=\"scale\" filename=\"in_accel" + n +
           "_scale\"/><attribute name=\"label\" filename=\"in_accel" + n + "_label\"/>";
    for (const auto& [name, text] : front_end.attributes) {
      if (name == "scale" || name == "label") continue;
      xml += "<attribute name=\"" + name + "\" filename=\"in_accel" + n + "_" + name + "\"/>";
    }
    xml += "</channel>";
  }
  return xml + "<attribute name=\"sampling_frequency\"/></device></context>";
}

}  // namespace

std::optional<std::string> IioSession::answer(const std::string& line) {
  std::string_view rest = line;
  const std::string_view command = next_word(rest);
  if (command == "EXIT") return std::nullopt;
  if (command == "VERSION") return "0.24.v0.24  \n";
  if (command == "PRINT") return with_length(context_of(front_end_));
  if (command == "TIMEOUT") return number(0);
  if (next_word(rest) != id) return number(command == "ZPRINT" ? -EINVAL : -ENODEV);
  if (command == "OPEN") {
    const std::string_view scans = next_word(rest);
    return open(scans, next_word(rest));
  }
  if (command == "CLOSE") {
    next_ = -1;
    return number(0);
  }
  if (command == "READBUF") return read_scans(next_word(rest));
  if (command == "READ") return read_attribute(rest);
  if (command == "SET") return number(0);  // buffers of the kernel: there is none
  if (command == "GETTRIG") return number(-ENOENT);
  if (command == "WRITE") {
    const auto bytes = parsed<std::size_t>(rest.substr(rest.rfind(' ') + 1), 10);
    if (!bytes || *bytes == 0 || *bytes > 4096) return number(-EINVAL);
    awaited_bytes_ = *bytes;
    return "";
  }
  return number(-EINVAL);
}

// Its only rate stays as it is, whatever is asked for; the client reads it back.
std::string IioSession::answer_to_bytes() { return number(long(std::exchange(awaited_bytes_, 0))); }

std::string IioSession::open(std::string_view scans, std::string_view mask) {
  const auto count = parsed<std::size_t>(scans, 10);
  const auto enabled = parsed<std::uint64_t>(mask, 16);
  const std::size_t channels = front_end_.labels.size();
  if (!count || !enabled || *enabled == 0 || *enabled >> channels != 0) return number(-EINVAL);
  mask_ = mask;
  enabled_ = *enabled;
  next_ = ring_.newest();
  return number(0);
}

std::string IioSession::read_scans(std::string_view bytes) {
  const auto wanted = parsed<std::size_t>(bytes, 10);
  if (next_ < 0) return number(-EBADF);
  const std::size_t scan_bytes = sizeof(std::int32_t) * std::size_t(std::popcount(enabled_));
  if (!wanted || *wanted < scan_bytes || *wanted > (1U << 26U)) return number(-EINVAL);
  const std::size_t count = *wanted / scan_bytes;
  const auto scans = ring_.wait(next_, count, patience_s);
  if (!scans) return number(ring_.has_lost(next_) ? -EOVERFLOW : -ETIMEDOUT);
  next_ += std::int64_t(count);
  std::string answer = number(long(count * scan_bytes)) + mask_ + "\n";
  const std::size_t channels = front_end_.labels.size();
  for (std::size_t i = 0; i < scans->size(); ++i) {
    if ((enabled_ >> (i % channels) & 1U) == 0) continue;
    const auto count_bits = static_cast<std::uint32_t>((*scans)[i]);
    for (int shift = 0; shift < 32; shift += 8) answer += char(count_bits >> shift & 0xFFU);
  }
  return answer;
}

std::string IioSession::read_attribute(std::string_view words) const {
  std::string_view rest = words;
  const std::string_view first = next_word(rest);
  if (first == "sampling_frequency") return with_length(decimal(front_end_.rate_Hz));
  if (first != "INPUT") return number(-ENOENT);
  std::string_view channel = next_word(rest);
  const std::string_view attribute = next_word(rest);
  if (!channel.starts_with("accel")) return number(-ENOENT);
  channel.remove_prefix(5);
  const auto at = parsed<std::size_t>(channel, 10);
  if (!at || *at >= front_end_.labels.size()) return number(-ENOENT);
  const auto told = front_end_.attributes.find(std::string(attribute));
  if (told != front_end_.attributes.end()) {
    return told->second.empty() ? number(-EIO) : with_length(told->second);
  }
  if (attribute == "scale") return with_length(decimal(front_end_.m_s2_per_count));
  if (attribute == "label") return with_length(front_end_.labels[*at]);
  return number(-ENOENT);
}

}  // namespace rvbench::sim
