#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <cmath>

#include "hal/formats/start_time.hpp"
#include "hal/formats/writer.hpp"
#include "hal/hdf5/attributes.hpp"
#include "hal/hdf5/plain_array.hpp"
#include "hal/hdf5/recording_skeleton.hpp"
#include "hal/hdf5/sample_group.hpp"

namespace rvbench::hal::formats {
namespace {

using namespace hdf5;

// Channels of one clock, as they stand beside each other in a dataset.
struct Group {
  std::string name;
  std::vector<const Channel*> channels;
};

// As rvbench's own recordings name them; what they have not are signals.
std::string kind_of(const Channel& channel) {
  if (channel.info.name == channel_names::input_torque) return "torque";
  if (channel.info.name == channel_names::input_angle) return "angle";
  return channel.info.unit == "m/s²" ? "acceleration" : "signals";
}

std::vector<Group> groups_of(const Recording& recording) {
  std::vector<Group> groups;
  for (const Channel& channel : recording.channels) {
    const std::string kind = kind_of(channel);
    const auto own = std::ranges::find_if(groups, [&](const Group& group) {
      return kind_of(*group.channels.front()) == kind &&
             is_one_clock(*group.channels.front(), channel);
    });
    if (own != groups.end()) {
      own->channels.push_back(&channel);
      continue;
    }
    const auto alike = std::ranges::count_if(
        groups, [&kind](const Group& group) { return kind_of(*group.channels.front()) == kind; });
    groups.push_back({alike == 0 ? kind : fmt::format("{}_{}", kind, alike + 1), {&channel}});
  }
  return groups;
}

Handle make_group(const Handle& parent, const std::string& path) {
  return own(H5Gcreate2(parent.id(), path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
             path);
}

// An attribute for what is known.
void state(const Handle& object, const char* name, double value) {
  if (std::isfinite(value)) write_number(object, name, value);
}

void write_group(const Handle& point, const Group& group) {
  const Channel& first = *group.channels.front();
  const Handle own_group = make_group(point, group.name);
  SampleGroup samples;
  samples.rate_Hz = first.rate_Hz;
  RowMajor rows(first.samples.size(), static_cast<Eigen::Index>(group.channels.size()));
  bool as_float = true;
  for (std::size_t i = 0; i < group.channels.size(); ++i) {
    samples.channels.push_back(group.channels[i]->info);
    rows.col(static_cast<Eigen::Index>(i)) = group.channels[i]->samples;
    as_float = as_float && are_single(group.channels[i]->samples);
  }
  write_sample_group(own_group, samples);
  write_number(own_group, "t0_s", first.start_s);
  state(own_group, "time_uncertainty_s", first.time_uncertainty_s);
  write_array(own_group, "data", rows, as_float);
}

// How a file was read is told of that file, for this is another.
std::string note_of(const std::string& source, const std::string& note) {
  constexpr std::string_view told = "read from ";
  if (source.empty() || note.starts_with(told)) return note;
  return fmt::format("{}{}: {}", told, source, note);
}

void write_point(const Handle& file, int number, const Recording& recording) {
  const Handle point = make_group(file, point_path(number));
  write_number(point, "speed_rpm", recording.planned_speed_rpm);
  write_number(point, "load_pct", recording.load_pct);
  write_integer(point, "repeat", recording.repeat);
  write_text(point, "status", recording.status);
  state(point, "measured_speed_rpm", recording.speed_rpm);
  state(point, "measured_torque_Nm", recording.torque_Nm);
  write_text(point, "source", recording.source);
  const std::string start = utc_text(noted_start_s(recording));
  if (!start.empty()) write_text(point, "start_time", start);
  std::vector<std::string> notes = recording.notes;
  std::erase_if(notes, [](const std::string& note) { return is_start_note(note); });
  for (std::string& note : notes) note = note_of(recording.source, note);
  if (!notes.empty()) write_texts(point, "notes", notes);
  for (const Group& group : groups_of(recording)) write_group(point, group);
}

void fill(const std::vector<Recording>& recordings, const std::filesystem::path& path) {
  const Handle access = file_access();
  Handle file =
      own(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose, "create");
  write_integer(file, "format_version", 1);
  make_group(file, "/points");
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    write_point(file, static_cast<int>(i), recordings[i]);
  }
  check(H5Fflush(file.id(), H5F_SCOPE_GLOBAL), "write");
  if (!file.close()) check(-1, "close");
}

// A recording of rvbench's own format, laid out as its RecordingWriter does, for any channels: with
// float samples where these are exact, with a start of its own for each group.
Status write_hdf5(const std::vector<Recording>& recordings, FileDraft& draft) {
  return guarded(draft.file(), [&]() -> Status {
    fill(recordings, draft.path());
    return Done{};
  });
}

}  // namespace

Writer hdf5_writer() {
  return {"hdf5", "HDF5", {".h5", ".hdf5"}, {.recordings = true, .clocks = true}, write_hdf5};
}

}  // namespace rvbench::hal::formats
