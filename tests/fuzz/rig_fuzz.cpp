#include "bench/rig_file.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".json");
  const auto rig = bench::read_rig(file.holding(data, size), {});
  test::must(rig.index() == 0 || !std::get<1>(rig).empty());
  return 0;
}
