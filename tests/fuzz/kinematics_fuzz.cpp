#include "bench/kinematics_file.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".json");
  const auto machine = bench::read_kinematics(file.holding(data, size));
  test::must(machine.index() == 0 || !std::get<1>(machine).empty());
  return 0;
}
