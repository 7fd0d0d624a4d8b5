#include "tests/fuzz/read_file_of.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".wav");
  test::read_file_of(file, data, size);
  return 0;
}
