#include "hal/hdf5/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>

#include "hal/hdf5/hdf5_handle.hpp"
#include "hal/hdf5/journal_record.hpp"
#include "hal/lock_alone.hpp"
#include "hal/put_on_disk.hpp"

namespace rvbench::hal::hdf5 {
namespace {

// Before each record; its checksum covers the first three and what follows.
struct Head {
  std::uint32_t magic = 0x314A5652;  // "RVJ1"
  std::uint32_t number = 0;
  std::uint32_t bytes = 0;
  std::uint32_t checksum = 0;
};

[[noreturn]] void fail(const char* what, int error) {
  throw FileFailure(IoErrc::refused, std::string("journal: ") + what + ": " + std::strerror(error));
}

std::uint32_t checksum_of(const Head& head, const char* record) {
  const std::array<std::uint32_t, 3> covered{head.magic, head.number, head.bytes};
  const uLong of_head = crc32(0, reinterpret_cast<const Bytef*>(covered.data()), sizeof(covered));
  return static_cast<std::uint32_t>(
      crc32(of_head, reinterpret_cast<const Bytef*>(record), head.bytes));
}

int open_locked(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) fail("create", errno);
  const int error = lock_alone(descriptor);
  if (error == 0) return descriptor;
  ::close(descriptor);
  fail("lock", error);
}

// The next whole record, or nothing.
std::optional<std::string> next_record(std::istream& in, std::uint32_t number,
                                       std::uintmax_t file_bytes) {
  Head head;
  in.read(reinterpret_cast<char*>(&head), sizeof(head));
  if (!in || head.magic != Head{}.magic || head.number != number || head.bytes > file_bytes) {
    return std::nullopt;
  }
  std::string record(head.bytes, '\0');
  in.read(record.data(), static_cast<std::streamsize>(record.size()));
  if (!in || checksum_of(head, record.data()) != head.checksum) return std::nullopt;
  return record;
}

// Moves on to the next bytes that look like the head of a record.
bool seek_head(std::istream& in) {
  const std::uint32_t magic = Head{}.magic;
  std::array<char, sizeof(magic)> last{};
  while (in.get(last.back())) {
    if (std::memcmp(last.data(), &magic, sizeof(magic)) == 0) {
      return static_cast<bool>(in.seekg(-static_cast<std::streamoff>(sizeof(magic)), in.cur));
    }
    std::rotate(last.begin(), last.begin() + 1, last.end());
  }
  return false;
}

// Whether after these bytes comes the result of a point, and a step after it. That result was on
// the disk before the step was taken, and so was all that precedes it: it is damaged, not cut off.
bool hides_a_result(std::istream& in, std::streamoff bytes, std::uintmax_t file_bytes) {
  in.clear();
  in.seekg(bytes);
  bool after_result = false;
  while (seek_head(in)) {
    const std::istream::pos_type place = in.tellg();
    Head head;
    in.read(reinterpret_cast<char*>(&head), sizeof(head));
    in.seekg(place);
    const std::optional<std::string> record = next_record(in, head.number, file_bytes);
    if (record && after_result) return true;
    after_result = record && std::holds_alternative<PointResult>(record_of(*record));
    if (record) continue;
    in.clear();
    in.seekg(place + std::streamoff{1});
  }
  return false;
}

void demand(const Status& status) {
  if (!status) throw FileFailure(status.error().code, status.error().where);
}

void write_again(const JournalRecord& record, RecordingWriter& writer) {
  if (const auto* step = std::get_if<AccelerationStep>(&record)) {
    demand(writer.append(step->point, step->block));
  } else if (const auto* torque = std::get_if<TorqueStep>(&record)) {
    demand(writer.append(torque->point, torque->block));
  } else if (const auto* result = std::get_if<PointResult>(&record)) {
    demand(writer.end_point(*result));
  } else if (const auto* note = std::get_if<NoteStep>(&record)) {
    demand(writer.note(note->time_s, note->event));
  }
}

void do_again(const JournalRecord& record, RecordingWriter& writer) {
  try {
    write_again(record, writer);
  } catch (const std::invalid_argument& error) {  // here it is the file that is wrong
    throw FileFailure(IoErrc::bad_data, std::string("journal: ") + error.what());
  }
}

}  // namespace

std::filesystem::path journal_of(const std::filesystem::path& recording) {
  return recording.string() + ".journal";
}

bool is_left_behind(const std::filesystem::path& journal) { return is_locked(journal) == false; }

Journal::Journal(const std::filesystem::path& recording, const RecordingLayout& layout,
                 std::chrono::milliseconds sync_interval)
    : path_(journal_of(recording)), descriptor_(open_locked(path_)) {
  try {
    // One may be there of a recording that was never begun.
    if (::ftruncate(descriptor_, 0) != 0) fail("create", errno);
    add(bytes_of(layout));
    if (::fdatasync(descriptor_) != 0) fail("fdatasync", errno);
    if (const int error = sync_folder_of(path_); error != 0) fail("fsync of the folder", error);
    sync_.emplace(descriptor_, sync_interval);
  } catch (...) {
    ::unlink(path_.c_str());
    ::close(descriptor_);
    throw;
  }
}

Journal::~Journal() {
  sync_.reset();
  ::close(descriptor_);
}

void Journal::add(const std::string& record) {
  Head head{.number = next_, .bytes = static_cast<std::uint32_t>(record.size())};
  head.checksum = checksum_of(head, record.data());
  std::string all(reinterpret_cast<const char*>(&head), sizeof(head));
  all += record;
  for (std::size_t written = 0; written < all.size();) {
    const ssize_t more = ::write(descriptor_, all.data() + written, all.size() - written);
    if (more < 0 && errno != EINTR) fail("write", errno);
    if (more > 0) written += static_cast<std::size_t>(more);
  }
  ++next_;
}

void Journal::sync() {
  sync_->sync();
  check_disk();
}

void Journal::check_disk() const {
  if (const int error = sync_->error(); error != 0) fail("fdatasync", error);
}

void Journal::remove() {
  if (::unlink(path_.c_str()) != 0) fail("remove", errno);
  // If it came back after a power failure, it would make the file anew that others know by its
  // hash.
  if (const int error = sync_folder_of(path_); error != 0) fail("fsync of the folder", error);
}

std::unique_ptr<RecordingWriter> replay_journal(
    const std::filesystem::path& journal,
    const std::function<std::unique_ptr<RecordingWriter>(const RecordingLayout&)>& begin) {
  std::ifstream in(journal, std::ios::binary);
  if (!in) fail("open", errno);
  const std::uintmax_t file_bytes = std::filesystem::file_size(journal);
  std::unique_ptr<RecordingWriter> writer;
  std::streamoff whole_bytes = 0;
  for (std::uint32_t number = 0; auto bytes = next_record(in, number, file_bytes); ++number) {
    const JournalRecord record = record_of(*bytes);
    const auto* layout = std::get_if<RecordingLayout>(&record);
    if ((layout != nullptr) != (number == 0)) {
      throw FileFailure(IoErrc::bad_data, "journal: does not begin with one layout");
    }
    if (layout != nullptr) writer = begin(*layout);
    do_again(record, *writer);
    whole_bytes = in.tellg();
  }
  if (in.bad()) fail("read", EIO);
  if (hides_a_result(in, whole_bytes, file_bytes)) {
    throw FileFailure(
        IoErrc::refused,
        fmt::format("journal: damaged at byte {}, before the end of a point that was measured; "
                    "neither it nor the recording was changed",
                    whole_bytes));
  }
  return writer;
}

}  // namespace rvbench::hal::hdf5
