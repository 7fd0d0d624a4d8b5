#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>

#include "bench/judgement.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::test {

inline constexpr const char* small_run_serial = "S1";

/// How a small run is made.
struct SmallRunOptions {
  bool resume = false;
  bool witnessed = false;  ///< what it promises goes to tell(), see Witness
  /// Seconds of the rig's time in a real one, with the threads of a real bench; 0: as fast as can
  /// be, and all in one thread.
  double pace = 0;
  hal::RecordingPace recording = {};
};

/// There could be no folder to run in, or to go on in: nothing has turned.
struct NoRunFolder : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct SmallRunEnd {
  bench::Judgement judgement;
  std::filesystem::path folder;
  bool at_rest = false;  ///< by the shaft itself, seconds after the end
};

/// An acceptance test of three points on the mirror rig, whose housing hums with its shaft and
/// teeth: a unit that passes. By the steps of `rvbench run`, into `root`/S1/<time>/.
/// @return nothing if there was no run to resume
/// @throws NoRunFolder; whatever else is thrown is a defect
std::optional<SmallRunEnd> make_small_run(const std::filesystem::path& root,
                                          const SmallRunOptions& options);

inline constexpr int small_run_points = 3;

}  // namespace rvbench::test
