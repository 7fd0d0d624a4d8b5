#include "hal/formats/file_draft.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <regex>
#include <utility>

#include "hal/put_on_disk.hpp"

namespace rvbench::hal::formats {
namespace {

IoError refused(const std::filesystem::path& file, const std::string& why) {
  return IoError{IoErrc::refused, file.string() + ": " + why};
}

// Gives the draft its name. In one step a name that is taken is refused only where the file system
// can do that; where it cannot, it was looked at before.
int give_name(const std::filesystem::path& draft, const std::filesystem::path& file,
              bool overwrite) {
  if (!overwrite) {
    if (::renameat2(AT_FDCWD, draft.c_str(), AT_FDCWD, file.c_str(), RENAME_NOREPLACE) == 0) {
      return 0;
    }
    if (errno != EINVAL && errno != ENOSYS) return errno;
    std::error_code unknown;
    if (std::filesystem::exists(file, unknown)) return EEXIST;
  }
  return std::rename(draft.c_str(), file.c_str()) == 0 ? 0 : errno;
}

// Of this process, and of this draft in it.
std::filesystem::path draft_of(const std::filesystem::path& file) {
  static std::atomic<unsigned> drafts = 0;
  return file.string() + fmt::format(".{}-{}.part", ::getpid(), ++drafts);
}

}  // namespace

std::filesystem::path drafted_file(const std::filesystem::path& draft) {
  static const std::regex name(R"((.+)\.\d+-\d+\.part)");
  const std::string text = draft.string();
  std::smatch parts;
  return std::regex_match(text, parts, name) ? parts[1].str() : "";
}

Status check_place(const std::filesystem::path& file, bool overwrite) {
  std::error_code unknown;
  const auto status = std::filesystem::status(file, unknown);
  if (!std::filesystem::exists(status)) return Done{};
  if (!std::filesystem::is_regular_file(status)) return refused(file, "is no regular file");
  if (!overwrite) return refused(file, "exists; --force replaces it");
  return Done{};
}

FileDraft::FileDraft(std::filesystem::path file, bool overwrite)
    : file_(std::move(file)), overwrite_(overwrite) {}

FileDraft::~FileDraft() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (is_made_) ::unlink(draft_.c_str());
}

Status FileDraft::failed(int error) {
  error_ = error;
  return refused(file_, std::strerror(error));
}

Status FileDraft::begin() {
  if (Status place = check_place(file_, overwrite_); !place) {
    std::error_code unknown;
    error_ = std::filesystem::is_directory(file_, unknown) ? EISDIR : EEXIST;
    return place;
  }
  // What has the name already is somebody else's, and may be a link to what is not to be touched.
  constexpr int most_tries = 100;
  for (int tries = 0; descriptor_ < 0; ++tries) {
    draft_ = draft_of(file_);
    descriptor_ = ::open(draft_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (descriptor_ < 0 && (errno != EEXIST || tries == most_tries)) return failed(errno);
  }
  is_made_ = true;
  return Done{};
}

Status FileDraft::write(std::string_view all) {
  while (!all.empty()) {
    const auto written = ::write(descriptor_, all.data(), all.size());
    if (written < 0 && errno != EINTR) return failed(errno);
    if (written > 0) all.remove_prefix(static_cast<std::size_t>(written));
  }
  return Done{};
}

Status FileDraft::write_first(std::string_view head) {
  if (::lseek(descriptor_, 0, SEEK_SET) < 0) return failed(errno);
  return write(head);
}

Status FileDraft::finish() {
  // What a library wrote under the draft's name is the same file.
  int error = ::fsync(descriptor_) == 0 ? 0 : errno;
  if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) error = errno;
  if (error == 0) error = give_name(draft_, file_, overwrite_);
  if (error != 0) return failed(error);
  is_made_ = false;
  error = sync_folder_of(file_);
  return error == 0 ? Status(Done{}) : failed(error);
}

}  // namespace rvbench::hal::formats
