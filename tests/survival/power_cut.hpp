#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "tests/survival/disk_record.hpp"

namespace rvbench::test {

/// What may be on a disk after its power failed at some moment of recorded processes.
///
/// Promised by ext4 (data=ordered) and XFS, and by POSIX: after fsync or fdatasync of a file what
/// was written to it before is there, with the size that it needs; after fsync of a folder so are
/// the names made, changed and removed in it before. A rename is there as a whole or not at all. A
/// sector of 512 bytes is written as a whole, and what was never written reads as zeros.
///
/// Nothing else is relied on. Of what was written since a file's last sync each page of 4 KiB may
/// be there as after any of the writes to it, whatever the order among pages; a page that was under
/// way may be new in some first sectors, or last ones, and old in the rest; the size is that of
/// any moment since. That a file's sync also keeps its name is true of both file systems and not
/// used. Names not synced are there up to some moment, as both file systems' logs have it, or, in
/// every other cut, any of them.
class PowerCut {
 public:
  /// @param entries  of all that ever wrote below `root`, which was empty and on the disk before;
  ///                 must outlive it
  /// @param syncs    false: as if no file had ever been synced
  PowerCut(std::filesystem::path root, const std::vector<DiskEntry>& entries, bool syncs);

  /// Makes the state after a cut right before entry `moment` below `to`, which is empty.
  void make(const std::filesystem::path& to, std::size_t moment, std::uint64_t seed) const;

 private:
  using Names = std::map<std::string, std::size_t>;  ///< path below root → index in files

  struct Change {  ///< of the names in one folder
    std::size_t entry;
    std::size_t of;              ///< that folder
    std::string name, new_name;  ///< new_name: of a rename
    DiskEntry::Kind kind;
    std::size_t file;  ///< that was made
  };

  struct File {
    bool is_folder = false;
    std::vector<std::size_t> changes;  ///< entries: writes and truncations
    std::vector<std::size_t> syncs;    ///< entries
  };

  std::string below_root(const std::string& path) const;
  void take_entry(std::size_t index);
  std::size_t add_file(const std::string& name, bool is_folder);
  Names names_at(std::size_t moment, std::mt19937_64& random) const;
  std::string bytes_at(const File& file, std::size_t moment, std::mt19937_64& random) const;
  std::size_t kept_until(const File& file, std::size_t moment) const;

  std::filesystem::path root_;
  const std::vector<DiskEntry>& entries_;
  bool syncs_;
  std::vector<File> files_;
  Names now_;                          ///< while entries are taken
  std::map<int, std::size_t> opened_;  ///< entry of an open() → file
  std::vector<Change> changes_;
};

}  // namespace rvbench::test
