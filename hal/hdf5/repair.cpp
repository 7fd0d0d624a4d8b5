#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/hdf5/hdf5_writer.hpp"
#include "hal/hdf5/journal.hpp"
#include "hal/hdf5/superblock.hpp"
#include "hal/lock_alone.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal {
namespace {

using namespace hdf5;

// Keeps others from repairing the same file, and refuses one that somebody is writing.
class RepairLock {
 public:
  explicit RepairLock(const std::filesystem::path& path)
      : descriptor_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) throw FileFailure(IoErrc::refused, std::strerror(errno));
    if (lock_alone(descriptor_) != EWOULDBLOCK) return;
    ::close(descriptor_);
    throw FileFailure(IoErrc::refused, "in use by another program: not repaired");
  }
  ~RepairLock() { ::close(descriptor_); }
  RepairLock(const RepairLock&) = delete;
  RepairLock& operator=(const RepairLock&) = delete;

 private:
  int descriptor_;
};

bool opens(const std::filesystem::path& path) {
  const Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  return static_cast<bool>(file);
}

// Without a journal: clears the mark of the dead writer and sets the file's recorded end to its
// real one. Clearing the mark alone (h5clear -s) would make an SWMR file unreadable for good: its
// recorded end is as old as the file's creation.
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

// Takes the place of the file that was being written when its writer died. In this order: at every
// moment either the journal is there, or the file made from it is on the disk.
// @return whether the journal held a recording
bool make_anew(const std::filesystem::path& file, const std::filesystem::path& journal) {
  const std::filesystem::path draft = file.string() + ".draft";
  std::error_code none_there;
  std::filesystem::remove(draft, none_there);
  const auto begin = [&](const RecordingLayout& layout) {
    return make_hdf5_writer(draft, layout, std::chrono::hours(1));
  };
  std::unique_ptr<RecordingWriter> writer;
  try {
    writer = replay_journal(journal, begin);
  } catch (...) {
    std::filesystem::remove(draft, none_there);
    throw;
  }
  if (writer == nullptr) return false;
  if (const Status closed = writer->close(); !closed) {
    throw FileFailure(closed.error().code, closed.error().where);
  }
  put_on_disk(draft);
  std::error_code error;
  std::filesystem::rename(draft, file, error);
  if (error) throw FileFailure(IoErrc::refused, "rename: " + error.message());
  put_folder_on_disk(file);
  return true;
}

void repair_from_journal(const std::filesystem::path& file) {
  const std::filesystem::path journal = journal_of(file);
  const RepairLock lock(journal);
  if (!make_anew(file, journal) && is_marked_open(file)) put_right(file);
  std::error_code error;
  std::filesystem::remove(journal, error);
  if (error) throw FileFailure(IoErrc::refused, "journal: remove: " + error.message());
  put_folder_on_disk(file);
}

}  // namespace

Status repair_recording(const std::filesystem::path& file) {
  return guarded(file, [&]() -> Status {
    if (std::filesystem::exists(journal_of(file))) {
      repair_from_journal(file);
    } else if (is_marked_open(file)) {
      static_cast<void>(RepairLock(file));  // only looked at: HDF5 locks the file itself
      put_right(file);
    }
    if (!opens(file)) check(-1, "open");
    return Done{};
  });
}

}  // namespace rvbench::hal
