#include <hdf5.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "hal/hdf5/attributes.hpp"
#include "hal/hdf5/point_reader.hpp"
#include "hal/hdf5/superblock.hpp"
#include "hal/hdf5/tables.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal {
namespace {

using namespace hdf5;

std::string text_of(const char* bytes, std::size_t size) {
  return std::string(bytes, std::find(bytes, bytes + size, '\0'));
}

// A file that is being written, or that a killed writer left behind, as an SWMR reader.
Handle open_file(const std::filesystem::path& path) {
  const bool growing = is_marked_open(path);
  const Handle access = file_access();
  // A reader may meet metadata half written and tries again, with pauses that double: 20 times
  // are some milliseconds, HDF5's default of 100 would hang on a damaged file.
  check(H5Pset_metadata_read_attempts(access.id(), growing ? 20 : 1), "open");
  const unsigned mode = H5F_ACC_RDONLY | (growing ? H5F_ACC_SWMR_READ : 0U);
  return own(H5Fopen(path.c_str(), mode, access.id()), H5Fclose, "open");
}

std::size_t bytes_on_disk(const std::filesystem::path& path) {
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (error) throw FileFailure(IoErrc::refused, "size: " + error.message());
  return bytes;
}

int number_of(const std::string& name) {
  int number = -1;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  return error == std::errc() && end == name.data() + name.size() ? number : -1;
}

class Hdf5RecordingReader final : public RecordingReader {
 public:
  explicit Hdf5RecordingReader(std::filesystem::path path)
      : path_(std::move(path)), file_(open_file(path_)), file_bytes_(bytes_on_disk(path_)) {
    read_points();
    read_tables();
  }

  const RecordingLayout& layout() const override { return layout_; }
  const std::vector<PointResult>& results() const override { return results_; }
  const std::vector<std::pair<double, std::string>>& events() const override { return events_; }
  Result<Recording> read(int point) override;

 private:
  void read_points();
  void read_layout(const std::string& point);
  void read_tables();
  void apply_index(int number, Recording& recording) const;

  std::filesystem::path path_;
  Handle file_;
  std::size_t file_bytes_;
  RecordingLayout layout_;
  std::vector<std::string> names_;  // of the points' groups: "000", "001", ...
  std::vector<IndexRow> index_;
  std::vector<PointResult> results_;
  std::vector<std::pair<double, std::string>> events_;
};

void Hdf5RecordingReader::read_points() {
  layout_.software = read_text(file_, "software").value_or("");
  const double version = read_number(file_, "format_version").value_or(1);
  if (version > 1) {
    throw FileFailure(IoErrc::bad_data, "format_version: written by a newer rvbench");
  }
  if (H5Lexists(file_.id(), "/points", H5P_DEFAULT) <= 0) {
    throw FileFailure(IoErrc::bad_data,
                      "not laid out as rvbench's recordings are: there is no group /points");
  }
  names_ = groups_in(file_, "/points");
  if (names_.empty()) throw FileFailure(IoErrc::bad_data, "/points: no points");
  for (const std::string& name : names_) {
    layout_.points.push_back(read_plan(file_, "/points/" + name));
  }
  read_layout("/points/" + names_.front());
}

void Hdf5RecordingReader::read_layout(const std::string& point) {
  for (const std::string& name : groups_in(file_, point)) {
    const SampleGroup samples = read_group_info(file_, point, name, file_bytes_);
    if (name == "acceleration") {
      layout_.acceleration_channels = samples.channels;
      layout_.acceleration_rate_Hz = samples.rate_Hz;
      layout_.acceleration_range_m_s2 = samples.full_scale;
    }
    if (name == "torque") layout_.torque_rate_Hz = samples.rate_Hz;
  }
}

void Hdf5RecordingReader::read_tables() {
  index_ = read_index(file_, file_bytes_);
  for (const IndexRow& row : index_) {
    results_.push_back({row.point, row.t0_s, text_of(row.status, sizeof(row.status)), row.speed_rpm,
                        row.torque_Nm, row.acceleration_time_uncertainty_s,
                        row.torque_time_uncertainty_s});
  }
  for (const EventRow& row : read_events(file_, file_bytes_)) {
    events_.emplace_back(row.time_s, text_of(row.text, sizeof(row.text)));
  }
}

Result<Recording> Hdf5RecordingReader::read(int point) {
  if (point < 0 || static_cast<std::size_t>(point) >= names_.size()) {
    throw std::invalid_argument("RecordingReader::read: point " + std::to_string(point) +
                                " is not within [0, " + std::to_string(names_.size()) + ")");
  }
  const std::string& name = names_[static_cast<std::size_t>(point)];
  return guarded(path_, [&]() -> Result<Recording> {
    Recording recording = read_point(file_, "/points/" + name, file_bytes_);
    recording.source = path_.string() + "#" + name;
    apply_index(number_of(name), recording);
    // rvbench writes the status last; other programs may state none.
    if (recording.status.empty()) {
      recording.status = layout_.software.empty() ? "ok" : "interrupted";
    }
    return recording;
  });
}

void Hdf5RecordingReader::apply_index(int number, Recording& recording) const {
  const auto row = std::find_if(index_.begin(), index_.end(),
                                [number](const IndexRow& r) { return r.point == number; });
  if (row == index_.end()) return;
  recording.status = text_of(row->status, sizeof(row->status));
  recording.speed_rpm = row->speed_rpm;
  recording.torque_Nm = row->torque_Nm;
  for (Channel& channel : recording.channels) {
    const bool is_shaft = is_of_shaft(channel.info);
    const double first_s = is_shaft ? row->torque_t0_s : row->acceleration_t0_s;
    channel.start_s = std::isnan(first_s) ? row->t0_s : first_s;
    channel.time_uncertainty_s =
        is_shaft ? row->torque_time_uncertainty_s : row->acceleration_time_uncertainty_s;
  }
}

}  // namespace

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::filesystem::path& file) {
  return hdf5::guarded(file, [&]() -> Result<std::unique_ptr<RecordingReader>> {
    return std::unique_ptr<RecordingReader>(std::make_unique<Hdf5RecordingReader>(file));
  });
}

}  // namespace rvbench::hal
