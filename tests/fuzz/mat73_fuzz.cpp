#include <hdf5.h>

#include "hal/formats/read_recordings.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const test::ScratchFile file(".mat");
  const auto recordings = hal::read_recordings(file.holding(data, size));
  test::must(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0);  // no handle was left open
  if (!recordings) {
    test::must(!recordings.error().where.empty());
    return 0;
  }
  for (const Recording& recording : recordings.value()) {
    test::must(!recording.status.empty() && !recording.channels.empty());
  }
  return 0;
}
