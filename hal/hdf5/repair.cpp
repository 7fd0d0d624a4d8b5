#include <fcntl.h>
#include <hdf5.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/hdf5/superblock.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal {
namespace {

using namespace hdf5;

void refuse_if_in_use(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw FileFailure(IoErrc::refused, std::strerror(errno));
  const bool busy = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  if (busy) throw FileFailure(IoErrc::refused, "in use by another program: not repaired");
}

bool opens(const std::filesystem::path& path) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  return static_cast<bool>(file);
}

// Clears the mark of the dead writer and sets the file's recorded end to its real one. Clearing
// the mark alone (h5clear -s) would make an SWMR file unreadable for good: its recorded end is
// as old as the file's creation.
void put_right(const std::filesystem::path& path) {
  const Handle access = file_access();
  const hbool_t yes = 1;
  // Both properties belong to HDF5's own h5clear and have no public function.
  check(H5Pset(access.id(), "clear_status_flags", &yes), "repair");
  check(H5Pset(access.id(), "skip_eof_check", &yes), "repair");
  Handle file = own(H5Fopen(path.c_str(), H5F_ACC_RDWR, access.id()), H5Fclose, "repair");
  check(H5Fincrement_filesize(file.id(), 0), "repair");
  if (!file.close()) check(-1, "repair");
}

}  // namespace

Status repair_recording(const std::filesystem::path& file) {
  return guarded(file, [&]() -> Status {
    if (is_marked_open(file)) {
      refuse_if_in_use(file);
      put_right(file);
    }
    if (!opens(file)) check(-1, "open");
    return Done{};
  });
}

}  // namespace rvbench::hal
