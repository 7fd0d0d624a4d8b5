#include "hal/hdf5/hdf5_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "hal/hdf5/growing_series.hpp"
#include "hal/hdf5/recording_skeleton.hpp"
#include "hal/hdf5/tables.hpp"
#include "hal/put_on_disk.hpp"

namespace rvbench::hal::hdf5 {
namespace {

using Pace = std::chrono::steady_clock;  // of the disk: real time, also when the rig's is not

// Copies as many whole UTF-8 characters as fit, and a final 0.
template <std::size_t N>
void copy_text(char (&to)[N], const std::string& from) {
  std::size_t length = std::min(from.size(), N - 1);
  const auto continues = [&from](std::size_t i) {
    return i < from.size() && (static_cast<unsigned char>(from[i]) & 0xC0U) == 0x80U;
  };
  while (length > 0 && continues(length)) --length;
  std::memset(to, 0, N);
  std::memcpy(to, from.data(), length);
}

class Hdf5RecordingWriter final : public RecordingWriter {
 public:
  Hdf5RecordingWriter(std::filesystem::path path, RecordingLayout layout,
                      std::chrono::milliseconds flush_interval)
      : path_(std::move(path)),
        layout_(std::move(layout)),
        flush_interval_(flush_interval),
        file_(make_skeleton(path_, layout_)),
        ended_(layout_.points.size(), false) {}

  ~Hdf5RecordingWriter() override;

  Status append(int point, const AccelerationBlock& block) override;
  Status append(int point, const TorqueBlock& block) override;
  Status end_point(const PointResult& result) override;
  Status note(double time_s, const std::string& event) override;
  Status close() override;

 private:
  // What is being written of one point.
  struct OpenPoint {
    int number = -1;
    std::optional<GrowingSeries<float>> acceleration, torque;
    std::optional<GrowingSeries<double>> angle;
    double acceleration_t0_s = not_known, torque_t0_s = not_known;
  };

  template <typename Body>
  Status write(Body&& body);
  void begin(int point);
  void flush();
  void flush_when_due();
  void finish_point();

  std::filesystem::path path_;
  RecordingLayout layout_;
  std::chrono::milliseconds flush_interval_;
  Handle file_;
  std::vector<bool> ended_;
  OpenPoint open_;
  Pace::time_point flushed_ = Pace::now();
  std::optional<IoError> failure_;  // the first one: after it nothing more is written
};

Hdf5RecordingWriter::~Hdf5RecordingWriter() {
  try {
    static_cast<void>(close());
  } catch (...) {  // out of memory, say: whoever wanted to know has called close()
  }
}

// Runs one step of writing. Once a step failed, all later ones fail likewise: a recording with a
// hole in it must not look whole.
template <typename Body>
Status Hdf5RecordingWriter::write(Body&& body) {
  if (!failure_ && !file_) failure_ = IoError{IoErrc::refused, path_.string() + ": is closed"};
  if (failure_) return *failure_;
  const Status status = guarded(path_, [&]() -> Status {
    body();
    return Done{};
  });
  if (!status) failure_ = status.error();
  return status;
}

void Hdf5RecordingWriter::begin(int point) {
  if (point < 0 || static_cast<std::size_t>(point) >= ended_.size()) {
    throw std::invalid_argument(
        fmt::format("RecordingWriter: point {} is not within [0, {})", point, ended_.size()));
  }
  if (ended_[static_cast<std::size_t>(point)]) {
    throw std::invalid_argument(fmt::format("RecordingWriter: point {} has ended", point));
  }
  if (open_.number == point) return;
  if (open_.number >= 0) {
    throw std::invalid_argument(
        fmt::format("RecordingWriter: point {} before point {} ended", point, open_.number));
  }
  OpenPoint opened;
  const std::string path = point_path(point);
  if (!layout_.acceleration_channels.empty()) {
    opened.acceleration.emplace(file_, path + "/acceleration/data",
                                layout_.acceleration_channels.size());
  }
  if (layout_.torque_rate_Hz > 0) {
    opened.torque.emplace(file_, path + "/torque/data", 1);
    opened.angle.emplace(file_, path + "/angle/data", 1);
  }
  opened.number = point;
  open_ = std::move(opened);
}

Status Hdf5RecordingWriter::append(int point, const AccelerationBlock& block) {
  const Eigen::Index channels = static_cast<Eigen::Index>(layout_.acceleration_channels.size());
  if (channels == 0 || block.scans.cols() != channels) {
    throw std::invalid_argument(
        fmt::format("RecordingWriter::append: {} channels, not {}", block.scans.cols(), channels));
  }
  return write([&] {
    begin(point);
    if (block.scans.rows() == 0) return;
    if (std::isnan(open_.acceleration_t0_s)) open_.acceleration_t0_s = block.t0_s;
    open_.acceleration->append(block.scans.data(), static_cast<std::size_t>(block.scans.rows()));
    flush_when_due();
  });
}

Status Hdf5RecordingWriter::append(int point, const TorqueBlock& block) {
  if (layout_.torque_rate_Hz == 0) {
    throw std::invalid_argument("RecordingWriter::append: the layout has no torque");
  }
  return write([&] {
    begin(point);
    if (block.samples.empty()) return;
    if (std::isnan(open_.torque_t0_s)) open_.torque_t0_s = block.t0_s;
    for (const TorqueSample& sample : block.samples) {
      const float torque_Nm = static_cast<float>(sample.torque_Nm);
      open_.torque->append(&torque_Nm, 1);
      open_.angle->append(&sample.angle_rad, 1);
    }
    flush_when_due();
  });
}

Status Hdf5RecordingWriter::end_point(const PointResult& result) {
  if (result.status.size() >= sizeof(IndexRow::status)) {
    throw std::invalid_argument("RecordingWriter::end_point: status \"" + result.status +
                                "\" is longer than 31 bytes");
  }
  return write([&] {
    begin(result.point);
    IndexRow row;
    row.point = result.point;
    row.t0_s = result.t0_s;
    copy_text(row.status, result.status);
    row.speed_rpm = result.speed_rpm;
    row.torque_Nm = result.torque_Nm;
    row.acceleration_t0_s = open_.acceleration_t0_s;
    row.torque_t0_s = open_.torque_t0_s;
    row.acceleration_time_uncertainty_s = result.acceleration_time_uncertainty_s;
    row.torque_time_uncertainty_s = result.torque_time_uncertainty_s;
    finish_point();
    append_row(file_, row);
    ended_[static_cast<std::size_t>(result.point)] = true;
  });
}

Status Hdf5RecordingWriter::note(double time_s, const std::string& event) {
  return write([&] {
    EventRow row;
    row.time_s = time_s;
    copy_text(row.text, event);
    append_row(file_, row);
  });
}

void Hdf5RecordingWriter::flush_when_due() {
  if (Pace::now() - flushed_ < flush_interval_) return;
  flush();
  flushed_ = Pace::now();
}

void Hdf5RecordingWriter::flush() {
  if (open_.acceleration) open_.acceleration->flush();
  if (open_.torque) open_.torque->flush();
  if (open_.angle) open_.angle->flush();
}

void Hdf5RecordingWriter::finish_point() {
  flush();
  if (open_.acceleration) open_.acceleration->close();
  if (open_.torque) open_.torque->close();
  if (open_.angle) open_.angle->close();
  open_ = OpenPoint{};
}

Status Hdf5RecordingWriter::close() {
  if (!file_ && !failure_) return Done{};
  return write([&] {
    finish_point();
    if (!file_.close()) check(-1, "close");
  });
}

}  // namespace

std::unique_ptr<RecordingWriter> make_hdf5_writer(const std::filesystem::path& file,
                                                  const RecordingLayout& layout,
                                                  std::chrono::milliseconds flush_interval) {
  return std::make_unique<Hdf5RecordingWriter>(file, layout, flush_interval);
}

void put_on_disk(const std::filesystem::path& file) {
  const int error = sync_file(file);
  if (error != 0) throw FileFailure(IoErrc::refused, std::string("fsync: ") + std::strerror(error));
}

void put_folder_on_disk(const std::filesystem::path& file) {
  const int error = sync_folder_of(file);
  if (error == 0) return;
  throw FileFailure(IoErrc::refused, std::string("fsync of the folder: ") + std::strerror(error));
}

}  // namespace rvbench::hal::hdf5
