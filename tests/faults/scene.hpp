#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>

#include "hal/rig.hpp"
#include "hal/types/outcome.hpp"
#include "tests/faults/fault_run.hpp"
#include "tests/faults/kept_recording.hpp"
#include "tests/faults/witnessed_drive.hpp"

namespace rvbench::test {

/// One run made ready: a bench, a rig over it, a recording on the disk, a fault that waits for its
/// moment.
class Scene {
 public:
  /// @param on_kill  what becomes of the process when the controller is to be killed
  Scene(const FaultCase& fault, const std::filesystem::path& recording, const Guard* without,
        std::function<void(Scene&)> on_kill);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  Ending measure();    ///< what the controller makes of it
  void leave_alone();  ///< time goes on, and nobody is there any more
  void judge_plant();  ///< by what it did until now
  void judge_recording(Ending& ending);

  const FaultBench& bench() const { return bench_; }
  const KeptRecording& recording() const { return *recording_; }
  FaultReport& report() { return report_; }

 private:
  void strike();

  const FaultCase& fault_;
  std::filesystem::path file_;
  std::function<void(Scene&)> on_kill_;
  sequences::TestPlan plan_;
  RecordCheck check_;
  std::unique_ptr<FaultBench> owned_;
  FaultBench& bench_;
  Witness witness_;
  hal::Rig rig_;
  std::unique_ptr<KeptRecording> recording_;
  std::stop_source stop_;
  FaultReport report_;
  double struck_s_ = not_known;
  bool was_driven_ = false;
};

}  // namespace rvbench::test
