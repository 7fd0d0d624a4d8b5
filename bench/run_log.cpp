#include "bench/run_log.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/run_folder.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {

namespace {

bool ends_within_a_line(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::ate);
  if (!in || in.tellg() <= 0) return false;
  in.seekg(-1, std::ios::end);
  return in.get() != '\n';
}

}  // namespace

std::vector<std::pair<double, std::string>> events_in(const std::filesystem::path& file) {
  std::vector<std::pair<double, std::string>> events;
  std::ifstream in(file);
  for (std::string text; std::getline(in, text);) {
    const auto line = json_or_discarded(text);
    if (!line.is_object() || !line.contains("event") || !line.contains("time_s")) continue;
    if (!line["event"].is_string() || !line["time_s"].is_number()) continue;
    events.emplace_back(line["time_s"].get<double>(), line["event"].get<std::string>());
  }
  return events;
}

RunLog::RunLog(const std::filesystem::path& file, ProgressBar& bar)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644)),
      bar_(bar),
      events_(events_in(file)) {
  if (descriptor_ < 0) error_ = errno;
  if (ends_within_a_line(file)) write("\n");  // a killed run's: the next event needs its own
}

RunLog::~RunLog() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RunLog::progress(double done_s, double total_s, const std::string& doing) {
  bar_.show("measure", total_s > 0 ? done_s / total_s : 0, doing);
}

void RunLog::event(double time_s, const std::string& text) {
  events_.emplace_back(time_s, text);
  const nlohmann::ordered_json line =
      hal::json_object({{"utc", utc_now()}, {"time_s", time_s}, {"event", text}});
  write(json_line(line) + "\n");
}

void RunLog::write(const std::string& text) {
  if (descriptor_ < 0) return;
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t more = ::write(descriptor_, text.data() + written, text.size() - written);
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) {
      if (error_ == 0) error_ = errno;
      return;
    }
    written += static_cast<std::size_t>(more);
  }
}

}  // namespace rvbench::bench
