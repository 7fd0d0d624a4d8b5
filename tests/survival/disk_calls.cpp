#include "tests/survival/disk_calls.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <ctime>
#include <mutex>
#include <stdexcept>
#include <string_view>

#include "tests/survival/disk_record.hpp"

namespace rvbench::test {
namespace {

using Kind = DiskEntry::Kind;

struct Watch {
  DiskPlan plan;
  int record = -1;
  long calls = 0;
  std::int64_t entries = 0;
  std::array<int, 4096> objects{};  // descriptor → number of its open() plus 1; 0: not watched
  std::array<std::string, 4096> paths{};
};

std::mutex mutex;
Watch* watch = nullptr;  // made once, and left to the end of the process

std::int64_t now_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1'000'000'000LL + now.tv_nsec;
}

void record(DiskEntry entry) {
  entry.time_ns = now_ns();
  append_entry(watch->record, entry);
  ++watch->entries;
}

void record_call(DiskEntry entry) {
  if (watch->plan.with_calls) record(std::move(entry));
}

bool is_watched(const char* path) {
  return watch != nullptr && path != nullptr &&
         std::string_view(path).starts_with(watch->plan.root);
}

int object_of(int descriptor) {
  if (watch == nullptr || descriptor < 0 || descriptor >= 4096) return -1;
  return watch->objects[static_cast<std::size_t>(descriptor)] - 1;
}

const std::string& path_of(int descriptor) {
  return watch->paths[static_cast<std::size_t>(descriptor)];
}

void kill_now() {
  record({.kind = Kind::told, .path = "killed"});
  ::syscall(SYS_kill, ::getpid(), SIGKILL);
}

// Counts a call that changes something. @return errno if it is to fail, else 0
int count(bool asks_for_space, const std::string& path) {
  ++watch->calls;
  const DiskPlan& plan = watch->plan;
  if (watch->calls == plan.kill_at) kill_now();
  if (plan.fail_at == 0 || watch->calls < plan.fail_at) return 0;
  const bool again = plan.fail_ever_after && (plan.error != ENOSPC || asks_for_space);
  if (watch->calls > plan.fail_at && !again) return 0;
  if (watch->calls == plan.fail_at) record({.kind = Kind::told, .path = "struck " + path});
  return plan.error;
}

int fail(int error) {
  errno = error;
  return -1;
}

bool is_next_killed_halfway() {
  return watch->plan.kill_halfway && watch->calls + 1 == watch->plan.kill_at;
}

// @param offset  -1: where the file stands, or at its end
ssize_t put(int descriptor, const char* bytes, std::size_t size, off_t offset) {
  const auto plainly = [&](std::size_t part) {
    return offset < 0 ? ::syscall(SYS_write, descriptor, bytes, part)
                      : ::syscall(SYS_pwrite64, descriptor, bytes, part, offset);
  };
  if (object_of(descriptor) < 0) return plainly(size);
  const std::lock_guard lock(mutex);
  if (is_next_killed_halfway()) plainly(size / 2);
  if (const int error = count(true, path_of(descriptor)); error != 0) return fail(error);
  off_t at = offset;
  if (offset < 0) {
    const bool appends = (::fcntl(descriptor, F_GETFL) & O_APPEND) != 0;
    at = ::lseek(descriptor, 0, appends ? SEEK_END : SEEK_CUR);
  }
  const ssize_t done = plainly(size);
  if (done > 0) {
    record_call({.kind = Kind::write,
                 .object = object_of(descriptor),
                 .offset = at,
                 .data = std::string(bytes, static_cast<std::size_t>(done))});
  }
  return done;
}

// The others may go on writing meanwhile: on the disk is what was written before it began.
int sync(int descriptor, long call) {
  const int object = object_of(descriptor);
  if (object < 0) return static_cast<int>(::syscall(call, descriptor));
  std::int64_t began = 0;
  {
    const std::lock_guard lock(mutex);
    if (const int error = count(true, path_of(descriptor)); error != 0) return fail(error);
    began = watch->entries;
  }
  const int done = static_cast<int>(::syscall(call, descriptor));
  const std::lock_guard lock(mutex);
  if (done == 0) record_call({.kind = Kind::sync, .object = object, .began = began});
  return done;
}

int truncate_to(int descriptor, off_t size) {
  if (object_of(descriptor) < 0) {
    return static_cast<int>(::syscall(SYS_ftruncate, descriptor, size));
  }
  const std::lock_guard lock(mutex);
  if (const int error = count(true, path_of(descriptor)); error != 0) return fail(error);
  const int done = static_cast<int>(::syscall(SYS_ftruncate, descriptor, size));
  if (done == 0) {
    record_call({.kind = Kind::truncate, .object = object_of(descriptor), .offset = size});
  }
  return done;
}

int open_file(const char* path, int flags, mode_t mode) {
  const auto plainly = [&] {
    return static_cast<int>(::syscall(SYS_openat, AT_FDCWD, path, flags, mode));
  };
  if (!is_watched(path)) return plainly();
  const std::lock_guard lock(mutex);
  const bool makes = (flags & (O_CREAT | O_TRUNC)) != 0;
  if (makes) {
    if (const int error = count(true, path); error != 0) return fail(error);
  }
  const int descriptor = plainly();
  if (descriptor < 0 || descriptor >= 4096) return descriptor;
  watch->objects[static_cast<std::size_t>(descriptor)] = static_cast<int>(watch->entries) + 1;
  watch->paths[static_cast<std::size_t>(descriptor)] = path;
  record_call({.kind = Kind::open, .count = makes ? 1 : 0, .path = path});
  if ((flags & O_TRUNC) != 0) {
    record_call({.kind = Kind::truncate, .object = object_of(descriptor), .offset = 0});
  }
  return descriptor;
}

// A call that changes names.
template <typename Call>
int change(bool is_ours, bool asks_for_space, DiskEntry entry, Call&& call) {
  if (!is_ours) return static_cast<int>(call());
  const std::lock_guard lock(mutex);
  if (const int error = count(asks_for_space, entry.path); error != 0) return fail(error);
  const int done = static_cast<int>(call());
  if (done == 0) record_call(std::move(entry));
  return done;
}

int unlink_file(const char* path) {
  return change(is_watched(path), false, {.kind = Kind::unlink, .path = path},
                [path] { return ::syscall(SYS_unlink, path); });
}

}  // namespace

void watch_disk(const DiskPlan& plan) {
  auto* made = new Watch;
  made->plan = plan;
  made->record = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, plan.record.c_str(),
                                            O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644));
  if (made->record < 0) throw std::runtime_error("survival: no record");
  watch = made;
}

void tell(const std::string& text) {
  const std::lock_guard lock(mutex);
  record({.kind = Kind::told, .path = text});
}

long disk_calls() {
  const std::lock_guard lock(mutex);
  return watch->calls;
}

}  // namespace rvbench::test

using namespace rvbench::test;

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t size) {
  return put(descriptor, static_cast<const char*>(bytes), size, -1);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  return put(descriptor, static_cast<const char*>(bytes), size, offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off64_t offset) {
  return put(descriptor, static_cast<const char*>(bytes), size, offset);
}

ssize_t writev(int descriptor, const iovec* parts, int count_of_parts) {
  if (object_of(descriptor) < 0) return ::syscall(SYS_writev, descriptor, parts, count_of_parts);
  std::string all;
  for (int i = 0; i < count_of_parts; ++i) {
    all.append(static_cast<const char*>(parts[i].iov_base), parts[i].iov_len);
  }
  return put(descriptor, all.data(), all.size(), -1);
}

int fsync(int descriptor) { return rvbench::test::sync(descriptor, SYS_fsync); }
int fdatasync(int descriptor) { return rvbench::test::sync(descriptor, SYS_fdatasync); }
int ftruncate(int descriptor, off_t size) noexcept { return truncate_to(descriptor, size); }
int ftruncate64(int descriptor, off64_t size) noexcept { return truncate_to(descriptor, size); }

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_file(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  return open_file(path, flags, mode);
}

int close(int descriptor) {
  if (object_of(descriptor) >= 0) {
    const std::lock_guard lock(mutex);
    watch->objects[static_cast<std::size_t>(descriptor)] = 0;
  }
  return static_cast<int>(::syscall(SYS_close, descriptor));
}

int rename(const char* from, const char* to) noexcept {
  return change(is_watched(from), true, {.kind = Kind::rename, .path = from, .data = to},
                [=] { return ::syscall(SYS_rename, from, to); });
}

int unlink(const char* path) noexcept { return unlink_file(path); }

int remove(const char* path) noexcept {
  struct stat about {};
  if (::lstat(path, &about) == 0 && S_ISDIR(about.st_mode)) {
    return static_cast<int>(::syscall(SYS_rmdir, path));
  }
  return unlink_file(path);
}

int mkdir(const char* path, mode_t mode) noexcept {
  return change(is_watched(path), true, {.kind = Kind::make_folder, .path = path},
                [=] { return ::syscall(SYS_mkdir, path, mode); });
}

}  // extern "C"
