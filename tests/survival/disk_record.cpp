#include "tests/survival/disk_record.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace rvbench::test {
namespace {

struct Head {
  DiskEntry::Kind kind;
  std::int32_t object;
  std::int64_t time_ns, offset, began;
  std::int32_t count;
  std::uint32_t path_bytes, data_bytes;
};

}  // namespace

void append_entry(int descriptor, const DiskEntry& entry) {
  Head head{};
  head.kind = entry.kind;
  head.object = entry.object;
  head.time_ns = entry.time_ns;
  head.offset = entry.offset;
  head.began = entry.began;
  head.count = entry.count;
  head.path_bytes = static_cast<std::uint32_t>(entry.path.size());
  head.data_bytes = static_cast<std::uint32_t>(entry.data.size());
  std::string all(reinterpret_cast<const char*>(&head), sizeof(head));
  all += entry.path;
  all += entry.data;
  // Not ::write(): that one is watched.
  if (::syscall(SYS_write, descriptor, all.data(), all.size()) != static_cast<long>(all.size())) {
    throw std::runtime_error("survival: the record cannot be written");
  }
}

std::vector<DiskEntry> read_entries(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<DiskEntry> entries;
  for (Head head{}; in.read(reinterpret_cast<char*>(&head), sizeof(head));) {
    DiskEntry entry{head.kind,  head.time_ns, head.object, head.offset,
                    head.began, head.count,   {},          {}};
    entry.path.resize(head.path_bytes);
    entry.data.resize(head.data_bytes);
    in.read(entry.path.data(), head.path_bytes);
    in.read(entry.data.data(), head.data_bytes);
    if (!in) break;
    entries.push_back(std::move(entry));
  }
  return entries;
}

}  // namespace rvbench::test
