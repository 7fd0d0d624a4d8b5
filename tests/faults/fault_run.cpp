#include "tests/faults/fault_run.hpp"

#include <string>

#include "tests/faults/killed_run.hpp"
#include "tests/faults/scene.hpp"

namespace rvbench::test {
namespace {

FaultReport run_to_its_end(const FaultCase& fault, const std::filesystem::path& file,
                           const Guard* without) {
  Scene scene(fault, file, without, {});
  Ending ending = scene.measure();
  scene.leave_alone();
  scene.judge_plant();
  scene.judge_recording(ending);
  return scene.report();
}

}  // namespace

FaultReport run_fault(const FaultCase& fault, const std::filesystem::path& folder,
                      const Guard* without) {
  const std::filesystem::path own = folder / ("run-" + std::to_string(fault.seed));
  std::filesystem::create_directory(own);
  const std::filesystem::path file = own / "recording.h5";
  const bool kills = fault.kind != nullptr && fault.kind->kills_controller;
  FaultReport report =
      kills ? run_killed(fault, file, without) : run_to_its_end(fault, file, without);
  std::filesystem::remove_all(own);
  return report;
}

}  // namespace rvbench::test
