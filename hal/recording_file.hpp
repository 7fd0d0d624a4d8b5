#pragma once

#include <Eigen/Core>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/accelerometers.hpp"
#include "hal/torque_sensor.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// What is planned for one point; fixed before the file switches to SWMR mode.
struct PlannedPoint {
  double speed_rpm = not_known;
  double load_pct = not_known;
  int repeat = 0;
};

/// All that is known before the first sample.
struct RecordingLayout {
  std::vector<PlannedPoint> points;
  std::vector<ChannelInfo> acceleration_channels;
  double acceleration_rate_Hz = 0;
  double acceleration_range_m_s2 = not_known;
  double torque_rate_Hz = 0;
  std::string software;  ///< "rvbench 0.1.0 (a1b2c3d)"
};

/// What is known about a point once it was recorded: one row of /points/index.
struct PointResult {
  int point = 0;
  double t0_s = 0;
  std::string status = "ok";  ///< at most 31 bytes: "ok", "unsettled", "samples_lost", ...
  double speed_rpm = not_known;
  double torque_Nm = not_known;
  double acceleration_time_uncertainty_s = not_known;  ///< of when, on the rig's clock
  double torque_time_uncertainty_s = not_known;
};

/// How often what was appended is handed on. In real time, also where the rig's is virtual.
struct RecordingPace {
  std::chrono::milliseconds flush{100};  ///< to readers that follow the file
  std::chrono::milliseconds sync{250};   ///< to the disk; of the second that a power failure may
                                         ///< cost, the rest is for the sync itself
};

/// Writes a recording: /points/<nnn>/{acceleration,torque,angle}/data with attributes,
/// /points/index, /events. HDF5 in SWMR mode; readable by h5py and MATLAB, also while it grows.
///
/// Order    create() → { append*() | note() | end_point() }* → close(); one point at a time, and
///          a point that ended takes no more samples
/// Loss     <file>.journal, there until close(), has each block when append() returns, so that
///          kill -9 costs none; a power failure costs at most 1 s, and no point that ended: when
///          end_point() returns, the disk has it. repair_recording() makes the file from it
/// Time     end_point() and close() wait for the disk, the others do not
/// Errors   IoError with file and place; after the first one nothing more is written.
///          @throws std::invalid_argument: a point not within the layout or out of order, another
///          number of channels, no points, a rate that is not above 0
/// Threads  one caller at a time
class RecordingWriter {
 public:
  /// Without acceleration channels, or with torque_rate_Hz 0, those groups are left out.
  /// An existing file is refused, never overwritten.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& file,
                                                         const RecordingLayout& layout,
                                                         RecordingPace pace = {});
  virtual ~RecordingWriter() = default;
  virtual Status append(int point, const AccelerationBlock& block) = 0;
  virtual Status append(int point, const TorqueBlock& block) = 0;
  virtual Status end_point(const PointResult& result) = 0;
  virtual Status note(double time_s, const std::string& event) = 0;  ///< cut at 255 bytes
  virtual Status close() = 0;  ///< also done by the destructor, without a report
};

/// Puts right what a killed writer or a power failure left behind, from the journal if there is
/// one; no-op on a sound file. Refuses a file that a living program is writing.
Status repair_recording(const std::filesystem::path& file);

/// Reads a recording made by RecordingWriter, point by point; also one that is being written, as
/// it was when opened, or that a killed writer left behind.
/// Of other programs' files, see hal/hdf5/point_reader.hpp for what they may leave out.
class RecordingReader {
 public:
  static Result<std::unique_ptr<RecordingReader>> open(const std::filesystem::path& file);
  virtual ~RecordingReader() = default;
  virtual const RecordingLayout& layout() const = 0;
  virtual const std::vector<PointResult>& results() const = 0;  ///< of the points that ended
  virtual const std::vector<std::pair<double, std::string>>& events() const = 0;

  /// The point's acceleration channels, input_torque and input_angle. Channels without samples
  /// if it was never begun; status "interrupted" if it never ended.
  /// @throws std::invalid_argument if point is not within layout().points
  virtual Result<Recording> read(int point) = 0;
};

}  // namespace rvbench::hal
