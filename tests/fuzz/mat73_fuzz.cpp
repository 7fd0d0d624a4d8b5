#include <hdf5.h>

#include "tests/fuzz/read_file_of.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".mat");
  test::read_file_of(file, data, size);
  test::must(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0);  // no handle was left open
  return 0;
}
