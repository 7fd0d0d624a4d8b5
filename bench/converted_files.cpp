#include "bench/converted_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

#include "bench/commands/commands.hpp"
#include "bench/rising_channels.hpp"
#include "hal/formats/column_name.hpp"
#include "hal/formats/time_column.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::bench {
namespace {

bool is_twice(const Recording& recording, const std::string& name) {
  return std::ranges::count_if(recording.channels, [&name](const Channel& channel) {
           return channel.info.name == name;
         }) > 1;
}

// A unit in a name is the one in which values were read.
void name_by_units(Recording& recording) {
  for (Channel& channel : recording.channels) {
    const std::string before = channel.info.name, unit = channel.info.unit;
    const std::string name = hal::formats::name_in_unit(before, unit);
    if (name == before) continue;
    channel.info.name = name;
    for (int n = 2; is_twice(recording, channel.info.name); ++n) {
      channel.info.name = fmt::format("{}_{}", name, n);
    }
    recording.notes.push_back(
        fmt::format("{} is called {}: its values are in {}", before, channel.info.name, unit));
  }
}

}  // namespace

PointSource point_source(const Recording& recording) {
  const std::string& source = recording.source;
  std::error_code unknown;
  const std::size_t stroke = source.rfind('#');
  if (stroke == std::string::npos || std::filesystem::exists(source, unknown)) return {source, ""};
  return {source.substr(0, stroke), source.substr(stroke + 1)};
}

std::optional<std::string> prepare_for_writing(Recording& recording) {
  if (const auto broken = what_breaks_the_clock(recording)) {
    return fmt::format("{}: {}; part the file there, or name otherwise what is no time",
                       recording.source, *broken);
  }
  hal::formats::drop_time_column(recording);
  name_by_units(recording);
  return std::nullopt;
}

std::string made_from_fault(const std::string& out, const std::vector<std::string>& files) {
  std::error_code none;
  const bool is_one = std::ranges::any_of(
      files, [&](const std::string& file) { return std::filesystem::equivalent(out, file, none); });
  return is_one ? out + " is what it would be made from" : "";
}

void tell_left_out_events(Console& console, const std::string& file) {
  const auto run = hal::RecordingReader::open(file);
  if (!run || run.value()->events().empty()) return;
  console.err << fmt::format("rvbench: warning: {}: the {} events of its run are left out\n", file,
                             run.value()->events().size());
}

void tell_notes_of(Console& console, const std::vector<Recording>& recordings) {
  std::set<std::string> told;
  for (const Recording& recording : recordings) {
    const std::string file = point_source(recording).file;
    for (const std::string& note : recording.notes) {
      if (told.insert(file + ": " + note).second) {
        console.err << "rvbench: note: " << file << ": " << note << '\n';
      }
    }
    if (recording.status == "ok") continue;
    console.err << "rvbench: warning: " << recording.source << ": status " << recording.status
                << '\n';
  }
}

void tell_written(Console& console, const std::vector<hal::WrittenFile>& files) {
  std::set<std::string> told;
  for (const hal::WrittenFile& written : files) {
    console.out << fmt::format("{}: {} channels\n", written.file.string(), written.channels);
    for (const std::string& warning : written.warnings) {
      if (told.insert(warning).second) console.err << "rvbench: warning: " << warning << '\n';
    }
  }
}

int refuse_writing(Console& console, const std::string& command, const IoError& error) {
  return error.code == IoErrc::bad_data ? refuse_data(console, error.where)
                                        : refuse_usage(console, command + ": " + error.where);
}

}  // namespace rvbench::bench
