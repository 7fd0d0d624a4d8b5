#include <hdf5.h>

#include "hal/formats/read_recordings.hpp"
#include "tests/fuzz/scratch_file.hpp"

using namespace rvbench;

// A handle that we leave open LeakSanitizer would not see, as the library's tables still lead to
// it: they are counted instead.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // HDF5 and MAT are told by their first bytes; the rest is a table.
  static const test::ScratchFile file(".csv");
  const auto recordings = hal::read_recordings(file.holding(data, size));
  test::must(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL) == 0);
  if (!recordings) {
    test::must(!recordings.error().where.empty());
    return 0;
  }
  test::must(!recordings.value().empty());
  return 0;
}
