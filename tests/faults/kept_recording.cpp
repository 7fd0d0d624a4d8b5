#include "tests/faults/kept_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "tests/faults/fault_bench.hpp"

namespace rvbench::test {
namespace {

const IoError no_space{IoErrc::refused, "No space left on device"};

bool is_same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

bool is_same(const hal::PointResult& a, const hal::PointResult& b) {
  return a.point == b.point && a.status == b.status && is_same(a.t0_s, b.t0_s) &&
         is_same(a.speed_rpm, b.speed_rpm) && is_same(a.torque_Nm, b.torque_Nm) &&
         is_same(a.acceleration_time_uncertainty_s, b.acceleration_time_uncertainty_s) &&
         is_same(a.torque_time_uncertainty_s, b.torque_time_uncertainty_s);
}

long lost_scans(const Recording& record) {
  long lost = 0;
  for (const Channel& channel : record.channels) {
    if (!is_of_shaft(channel.info)) lost += channel.samples.array().isNaN().count();
  }
  return lost;
}

void read_point(hal::RecordingReader& reader, const hal::PointResult& result,
                const PlantTruth& truth, const RecordCheck& check, ReadBack& all) {
  const auto lose = [&](const std::string& what) {
    all.losses.push_back(fmt::format("point {} ({}): {}", result.point, result.status, what));
  };
  const auto record = reader.read(result.point);
  if (!record) return lose("cannot be read: " + describe(record.error()));
  const std::string wrong = truth.contradiction(record.value());
  if (!wrong.empty()) lose(wrong);
  if (result.status != "ok") return;
  if (const long lost = lost_scans(record.value()); lost > 0) {
    lose(fmt::format("{} samples of it are lost", lost));
  }
  if (all.flaw.empty()) all.flaw = check(record.value());
}

}  // namespace

KeptRecording::KeptRecording(const std::filesystem::path& file,
                             const hal::RecordingLayout& layout) {
  auto made = hal::RecordingWriter::create(file, layout);
  if (!made) throw std::runtime_error("KeptRecording: " + describe(made.error()));
  writer_ = std::move(made).value();
}

Status KeptRecording::append(int point, const hal::AccelerationBlock& block) {
  if (disk_full) return no_space;
  if (Status ended = write_belated_end(); !ended) return ended;
  return writer_->append(point, block);
}

Status KeptRecording::append(int point, const hal::TorqueBlock& block) {
  if (disk_full) return no_space;
  if (Status ended = write_belated_end(); !ended) return ended;
  return writer_->append(point, block);
}

Status KeptRecording::end_point(const hal::PointResult& result) {
  if (disk_full) return no_space;
  if (Status before = write_belated_end(); !before) return before;
  if (acknowledges_early) belated_end_ = result;
  Status ended = acknowledges_early ? Status(Done{}) : writer_->end_point(result);
  if (ended) acknowledged_.push_back(result);
  return ended;
}

Status KeptRecording::write_belated_end() {
  if (!belated_end_) return Done{};
  return writer_->end_point(*std::exchange(belated_end_, std::nullopt));
}

Status KeptRecording::close() {
  if (Status ended = write_belated_end(); !ended) return ended;
  return writer_->close();
}

Status KeptRecording::note(double time_s, const std::string& event) {
  if (disk_full) return no_space;
  return writer_->note(time_s, event);
}

ReadBack read_back(const std::filesystem::path& file,
                   const std::vector<hal::PointResult>& acknowledged, const PlantTruth& truth,
                   const RecordCheck& check) {
  ReadBack all;
  if (const Status repaired = hal::repair_recording(file); !repaired) {
    all.losses.push_back("the recording cannot be repaired: " + describe(repaired.error()));
    return all;
  }
  const auto opened = hal::RecordingReader::open(file);
  if (!opened) {
    all.losses.push_back("the recording cannot be opened: " + describe(opened.error()));
    return all;
  }
  hal::RecordingReader& reader = *opened.value();
  for (const hal::PointResult& result : acknowledged) {
    const bool is_there = std::ranges::any_of(
        reader.results(), [&](const auto& stored) { return is_same(stored, result); });
    if (!is_there) {
      all.losses.push_back(fmt::format("point {} was acknowledged and is not there", result.point));
    } else {
      read_point(reader, result, truth, check, all);
    }
  }
  return all;
}

std::filesystem::path where_recordings_are_kept() {
  const std::filesystem::path memory = "/dev/shm";
  return std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
}

}  // namespace rvbench::test
