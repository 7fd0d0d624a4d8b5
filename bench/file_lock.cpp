#include "bench/file_lock.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "hal/lock_alone.hpp"

namespace rvbench::bench {
namespace {

constexpr int how = O_RDWR | O_CLOEXEC | O_NOFOLLOW;

// Linux refuses O_CREAT on somebody else's file in a folder such as /tmp (fs.protected_regular), so
// the two ways are tried one after the other; the file may come or go in between.
int open_or_make(const std::filesystem::path& file) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    int descriptor = open(file.c_str(), how);
    if (descriptor >= 0 || errno != ENOENT) return descriptor;
    descriptor = open(file.c_str(), how | O_CREAT | O_EXCL, 0666);
    if (descriptor >= 0) (void)fchmod(descriptor, 0666);  // whatever the umask says
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

}  // namespace

std::optional<FileLock> FileLock::take(const std::filesystem::path& file) {
  return lock(open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644), file);
}

std::optional<FileLock> FileLock::take_shared(const std::filesystem::path& file) {
  return lock(open_or_make(file), file);
}

std::optional<FileLock> FileLock::lock(int descriptor, const std::filesystem::path& file) {
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), file.string());
  FileLock lock(descriptor);
  const int error = hal::lock_alone(descriptor);
  if (error == 0) return lock;
  if (error == EWOULDBLOCK) return std::nullopt;
  throw std::system_error(error, std::generic_category(), file.string());
}

FileLock::FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

// Only a hint to people: a disk that is full makes no lock any looser.
void FileLock::sign() const {
  const std::string name = std::to_string(getpid()) + "\n";
  if (ftruncate(descriptor_, 0) != 0) return;
  [[maybe_unused]] const auto written = pwrite(descriptor_, name.data(), name.size(), 0);
}

}  // namespace rvbench::bench
