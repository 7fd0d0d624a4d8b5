#include "hal/formats/read_frequency_responses.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".txt");
  const auto responses = hal::read_frequency_responses(file.holding(data, size));
  if (!responses) {
    test::must(!responses.error().where.empty());
    return 0;
  }
  for (const FrequencyResponse& response : responses.value()) {
    test::must(response.step_Hz > 0 && response.values.size() > 1);
  }
  return 0;
}
