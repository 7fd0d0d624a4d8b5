#include "hal/formats/read_frequency_responses.hpp"
#include "hal/formats/read_recordings.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".uff");
  const std::string& path = file.holding(data, size);
  if (const auto recordings = hal::read_recordings(path)) {
    for (const Recording& recording : recordings.value()) test::must(!recording.status.empty());
  }
  const auto responses = hal::read_frequency_responses(path);
  if (!responses) {
    test::must(!responses.error().where.empty());
    return 0;
  }
  test::must(!responses.value().empty());
  for (const FrequencyResponse& response : responses.value()) {
    const Eigen::Index known = response.coherence.size();
    test::must(response.step_Hz > 0 && response.first_Hz >= 0 && response.values.size() > 0);
    test::must(known == 0 || known == response.values.size());
  }
  return 0;
}
