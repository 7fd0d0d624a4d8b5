#include "hal/hdf5/superblock.hpp"

#include <array>
#include <cstring>
#include <fstream>

#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::hdf5 {

// HDF5 file format specification 3.0, II.A: version at byte 8, consistency flags at byte 11.
bool is_marked_open(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) {
    throw FileFailure(IoErrc::disconnected, "no such file");
  }
  std::array<char, 12> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), head.size());
  if (!file) throw FileFailure(IoErrc::bad_data, "not a recording: shorter than an HDF5 header");
  if (std::memcmp(head.data(), "\x89HDF\r\n\x1a\n", 8) != 0) {
    throw FileFailure(IoErrc::bad_data, "not a recording: no HDF5 signature");
  }
  return head[8] == 3 && head[11] != 0;
}

}  // namespace rvbench::hal::hdf5
