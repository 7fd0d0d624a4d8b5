#include "hal/put_on_disk.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace rvbench::hal {
namespace {

int sync_opened(int descriptor) {
  const int error = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  return error;
}

}  // namespace

int sync_file(const std::filesystem::path& file) noexcept {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  return descriptor < 0 ? errno : sync_opened(descriptor);
}

int sync_folder_of(const std::filesystem::path& file) noexcept {
  const char* const here = ".";
  const std::filesystem::path folder = file.parent_path();
  const int descriptor =
      ::open(folder.empty() ? here : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return errno == EACCES ? 0 : errno;
  const int error = sync_opened(descriptor);
  return error == EINVAL || error == ENOTSUP ? 0 : error;
}

}  // namespace rvbench::hal
