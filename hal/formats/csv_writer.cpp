#include <fmt/format.h>

#include <iterator>

#include "hal/formats/writer.hpp"

// Source  RFC 4180, Common Format and MIME Type for Comma-Separated Values (CSV) Files
namespace rvbench::hal::formats {
namespace {

constexpr std::size_t written_at_once = 1U << 20U;

std::string cell(const std::string& text) {
  if (text.find_first_of(",;\t\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string head_of(const Recording& recording) {
  std::string line = "time_s";
  for (const Channel& channel : recording.channels) {
    const std::string& unit = channel.info.unit;
    line += ',' + cell(channel.info.name + (unit.empty() ? "" : " [" + unit + "]"));
  }
  return line + '\n';
}

// Numbers in the fewest digits that read back as they are.
Status write_csv(const std::vector<Recording>& recordings, FileDraft& draft) {
  const Recording& recording = recordings.front();
  const Channel& first = recording.channels.front();
  std::string text = head_of(recording);
  for (Eigen::Index i = 0; i < first.samples.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{}",
                   first.start_s + static_cast<double>(i) / first.rate_Hz);
    for (const Channel& channel : recording.channels) {
      fmt::format_to(std::back_inserter(text), ",{}", channel.samples[i]);
    }
    text += '\n';
    if (text.size() < written_at_once) continue;
    if (Status written = draft.write(text); !written) return written;
    text.clear();
  }
  return draft.write(text);
}

}  // namespace

Writer csv_writer() {
  return {"csv",
          "CSV",
          {".csv", ".txt"},
          {.directions = false, .sensitivities = false, .start_time = false, .facts = false},
          write_csv};
}

}  // namespace rvbench::hal::formats
