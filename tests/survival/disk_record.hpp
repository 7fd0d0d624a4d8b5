#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rvbench::test {

/// What a writing process did to its disk, and what it told, in order.
struct DiskEntry {
  enum class Kind : std::uint32_t {
    open,      ///< `path`; `count` is 1 if it may make the file
    write,     ///< `data` at `offset` of `object`
    truncate,  ///< `object` to `offset` bytes
    sync,      ///< `object`: what was done to it before entry `began` is on the disk
    rename,    ///< `path` to `data`
    unlink,    ///< `path`
    make_folder,
    told  ///< `path` is the text, see Witness
  };

  Kind kind = Kind::told;
  std::int64_t time_ns = 0;  ///< real time, monotonic
  int object = -1;           ///< which open() it came from: the number of that entry
  std::int64_t offset = 0;
  std::int64_t began = 0;
  int count = 0;
  std::string path = {};
  std::string data = {};
};

/// Appends an entry to a record file, past the calls that are watched: a process that is killed
/// right after it leaves it behind.
void append_entry(int descriptor, const DiskEntry& entry);

/// All whole entries of a record file.
std::vector<DiskEntry> read_entries(const std::filesystem::path& file);

}  // namespace rvbench::test
