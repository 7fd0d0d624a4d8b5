#pragma once

#include <catch2/catch.hpp>
#include <fstream>

#include "hal/formats/choose_writer.hpp"
#include "hal/formats/read_recordings.hpp"
#include "hal/formats/start_time.hpp"
#include "hal/formats/write_recordings.hpp"
#include "tests/support/bytes_in.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {

constexpr double start_utc_s = 1476442277;  // date -u -d '2016-10-14 10:51:17' +%s

/// A ramp of values that single precision holds.
inline Eigen::VectorXd ramp(Eigen::Index samples, double step) {
  return Eigen::VectorXd::LinSpaced(samples, -4 * step, static_cast<double>(samples - 5) * step);
}

/// One clock: an accelerometer with all that can be known of it, and a torque.
inline Recording exported() {
  Recording recording;
  recording.source = "recording.h5#012";
  recording.planned_speed_rpm = 605;
  recording.speed_rpm = 604.5;
  recording.load_pct = 50;
  recording.torque_Nm = 1.25;
  recording.repeat = 2;
  recording.status = "ok";
  hal::formats::note_start(start_utc_s, recording);
  recording.channels = {{{"accel_1x", "m/s²", "-Y", 0.0125}, 5000, 2.5, ramp(10, 0.25)},
                        {{"input_torque", "N·m", "", not_known}, 5000, 2.5, ramp(10, 0.125)}};
  return recording;
}

inline hal::formats::Writer writer_of(const std::string& key) {
  const auto writer = hal::formats::choose_writer("", key);
  REQUIRE(writer);
  return *writer;
}

inline std::vector<hal::WrittenFile> written_as(const std::string& key,
                                                const std::filesystem::path& file,
                                                const std::vector<Recording>& recordings) {
  auto written = hal::write_recordings(recordings, file, writer_of(key), false);
  if (!written) FAIL(written.error().where);
  return std::move(written).value();
}

inline std::vector<Recording> read_back(const std::filesystem::path& file) {
  auto read = hal::read_recordings(file);
  if (!read) FAIL(read.error().where);
  return std::move(read).value();
}

}  // namespace rvbench::test
