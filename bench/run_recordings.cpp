#include "bench/run_recordings.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace rvbench::bench {
namespace {

std::string recording_name(std::size_t number) {
  return number == 1 ? "recording.h5" : fmt::format("recording-{}.h5", number);
}

// Repairs what a killed run left behind.
Result<std::unique_ptr<hal::RecordingReader>> open_repaired(const std::filesystem::path& file) {
  const Status repaired = hal::repair_recording(file);
  if (!repaired) return repaired.error();
  return hal::RecordingReader::open(file);
}

Result<bool> is_empty(hal::RecordingReader& reader) {
  if (!reader.results().empty()) return false;
  for (std::size_t point = 0; point < reader.layout().points.size(); ++point) {
    const Result<Recording> record = reader.read(static_cast<int>(point));
    if (!record) return record.error();
    for (const Channel& channel : record.value().channels) {
      if (channel.samples.size() > 0) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::string> recording_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (std::string next = recording_name(1); std::filesystem::exists(folder / next);) {
    names.push_back(next);
    next = recording_name(names.size() + 1);
  }
  return names;
}

Status drop_empty_recordings(const std::filesystem::path& folder) {
  const std::vector<std::string> names = recording_names(folder);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    const auto opened = open_repaired(folder / *name);
    if (!opened) return opened.error();
    const Result<bool> empty = is_empty(*opened.value());
    if (!empty) return empty.error();
    if (!empty.value()) break;
    std::error_code error;
    std::filesystem::remove(folder / *name, error);
    if (error) return IoError{IoErrc::refused, *name + ": " + error.message()};
  }
  return Done{};
}

Result<RunRecordings> RunRecordings::open(const std::filesystem::path& folder) {
  RunRecordings run;
  for (const std::string& name : recording_names(folder)) {
    Result<std::unique_ptr<hal::RecordingReader>> opened = open_repaired(folder / name);
    if (!opened) return opened.error();
    run.readers_.push_back(std::move(opened).value());
    const hal::RecordingReader& reader = *run.readers_.back();
    if (run.readers_.size() > 1) run.resumed_at_point_ = run.next_point_;
    for (const hal::PointResult& result : reader.results()) {
      run.ended_[result.point] = run.readers_.size() - 1;
      run.next_point_ = result.status == "interrupted" ? result.point : result.point + 1;
    }
    run.points_ = static_cast<int>(reader.layout().points.size());
  }
  return run;
}

Result<Recording> RunRecordings::read(int point) {
  const auto found = ended_.find(point);
  if (found == ended_.end()) {
    throw std::invalid_argument(
        fmt::format("RunRecordings::read: point {} was not recorded", point));
  }
  return readers_[found->second]->read(point);
}

std::string RunRecordings::next_name() const { return recording_name(readers_.size() + 1); }

}  // namespace rvbench::bench
