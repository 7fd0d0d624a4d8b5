#include "bench/on_disk.hpp"

#include <system_error>

#include "hal/put_on_disk.hpp"

namespace rvbench::bench {

void throw_error(int error, const std::filesystem::path& file) {
  throw std::system_error(error, std::generic_category(), file.string());
}

void put_on_disk(const std::filesystem::path& file) {
  if (const int error = hal::sync_file(file); error != 0) throw_error(error, file);
}

void put_folder_on_disk(const std::filesystem::path& file) {
  if (const int error = hal::sync_folder_of(file); error != 0) throw_error(error, file);
}

}  // namespace rvbench::bench
