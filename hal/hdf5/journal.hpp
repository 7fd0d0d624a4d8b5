#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "hal/hdf5/disk_sync.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal::hdf5 {

/// "recording.h5.journal": as long as it is there, it is the recording, and the HDF5 file beside
/// it only a view for readers, made anew from it after a crash.
std::filesystem::path journal_of(const std::filesystem::path& recording);

/// Whether a journal is there that nobody writes any more: the recording needs repair_recording().
bool is_left_behind(const std::filesystem::path& journal);

/// All that a recording was handed, in order, each step with a number and a checksum of its own.
///
/// HDF5 changes its index blocks in place. Processes that read along are safe, because it writes
/// them in a careful order; a disk keeps no order between two syncs, and a power failure may leave
/// half of them. A file that only grows needs no order: what was synced is there, and what follows
/// is good up to the first record that is not whole.
///
/// It holds a lock while it lives, by which others see that somebody is still writing.
/// All throw FileFailure.
class Journal {
 public:
  /// Its first record is the layout. On the disk when this returns: no file that it stands for
  /// may be there before it.
  Journal(const std::filesystem::path& recording, const RecordingLayout& layout,
          std::chrono::milliseconds sync_interval);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void add(const std::string& record);  ///< made by bytes_of(); the kernel has it on return
  void sync();                          ///< the disk has it on return
  void check_disk() const;              ///< throws if a sync in the background failed

  /// Removes it: the recording itself is on the disk by now.
  void remove();

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::uint32_t next_ = 0;
  std::optional<DiskSync> sync_;
};

/// Does again what the journal holds, up to the first record that is not whole. A journal without
/// a whole layout stands for nothing: its recording was never begun.
/// @param begin  makes the writer that is given the steps
/// @return that writer, not closed; null if there was no layout
/// @throws FileFailure also if a point's result follows what is not whole: somebody was told of it,
/// and a repair would throw it away
std::unique_ptr<RecordingWriter> replay_journal(
    const std::filesystem::path& journal,
    const std::function<std::unique_ptr<RecordingWriter>(const RecordingLayout&)>& begin);

}  // namespace rvbench::hal::hdf5
