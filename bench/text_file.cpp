#include "bench/text_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <sstream>

#include "bench/on_disk.hpp"

namespace rvbench::bench {
namespace {

// Writes and syncs; 0, or errno.
int fill(int fd, const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const auto more = write(fd, text.data() + written, text.size() - written);
    if (more < 0 && errno != EINTR) return errno;
    written += static_cast<std::size_t>(std::max<ssize_t>(0, more));
  }
  return fsync(fd) == 0 ? 0 : errno;
}

}  // namespace

std::string reason_of(const std::system_error& error) {
  const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
  return file == nullptr ? error.what() : file->path1().string() + ": " + error.code().message();
}

std::filesystem::path draft_of(const std::filesystem::path& file) {
  return file.string() + ".draft";
}

void write_file(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path draft = draft_of(file);
  const int fd = open(draft.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) throw_error(errno, file);
  int error = fill(fd, text);
  if (close(fd) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(draft.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) {
    unlink(draft.c_str());
    throw_error(error, file);
  }
  put_folder_on_disk(file);
}

std::optional<std::string> read_file(const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return std::nullopt;  // a pipe would block
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad() || text.bad()) return std::nullopt;
  return text.str();
}

}  // namespace rvbench::bench
