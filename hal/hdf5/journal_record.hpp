#pragma once

#include <string>
#include <variant>

#include "hal/recording_file.hpp"

namespace rvbench::hal::hdf5 {

// The steps of a recording.

struct AccelerationStep {
  int point = 0;
  AccelerationBlock block;
};

struct TorqueStep {
  int point = 0;
  TorqueBlock block;
};

struct NoteStep {
  double time_s = 0;
  std::string event;
};

using JournalRecord =
    std::variant<RecordingLayout, AccelerationStep, TorqueStep, PointResult, NoteStep>;

/// What the journal keeps of a step: its bytes, in the order of this machine. A block's `lost` is
/// left out, as in the recording: lost samples are there as NaN.
std::string bytes_of(const RecordingLayout& layout);
std::string bytes_of(int point, const AccelerationBlock& block);
std::string bytes_of(int point, const TorqueBlock& block);
std::string bytes_of(const PointResult& result);
std::string bytes_of(double time_s, const std::string& event);

/// The inverse. @throws FileFailure if `bytes` are none of these
JournalRecord record_of(std::string_view bytes);

}  // namespace rvbench::hal::hdf5
