#include "hal/hdf5/global_heap.hpp"

#include <fcntl.h>
#include <hdf5.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <string_view>

namespace rvbench::hal::hdf5 {
namespace {

// HDF5 file format specification 3.0, III.E, for the eight-byte lengths that HDF5 writes unless it
// is told otherwise.
constexpr std::string_view collection_head{"GCOL\x01\0\0\0", 8};
constexpr std::uint64_t head_bytes = 16;  // of a collection, and of an object
constexpr std::uint64_t alignment = 8;

// A file's bytes, as long as it lives; empty if it cannot be mapped.
class MappedFile {
 public:
  explicit MappedFile(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0) return;
    struct stat about {};
    if (::fstat(file, &about) == 0 && about.st_size > 0) {
      bytes_ = static_cast<std::size_t>(about.st_size);
      data_ = ::mmap(nullptr, bytes_, PROT_READ, MAP_PRIVATE, file, 0);
    }
    ::close(file);
  }
  ~MappedFile() {
    if (data_ != MAP_FAILED) ::munmap(data_, bytes_);
  }
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  std::string_view bytes() const {
    return data_ == MAP_FAILED ? std::string_view()
                               : std::string_view(static_cast<const char*>(data_), bytes_);
  }

 private:
  void* data_ = MAP_FAILED;
  std::size_t bytes_ = 0;
};

template <typename Number>
Number number_at(std::string_view bytes, std::uint64_t at) {
  Number value{};
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// Whether all objects of the collection that these bytes begin with lie within it.
bool is_sound(std::string_view bytes) {
  if (bytes.size() < head_bytes) return false;
  const auto size = number_at<std::uint64_t>(bytes, 8);
  if (size < head_bytes || size > bytes.size()) return false;
  std::uint64_t at = head_bytes;
  while (size - at >= head_bytes) {  // less is too little for an object: it is free
    const auto index = number_at<std::uint16_t>(bytes, at);
    const auto asked = number_at<std::uint64_t>(bytes, at + 8);
    if (asked > size - at) return false;
    // What is free counts its own head.
    const std::uint64_t takes =
        index == 0 ? asked : head_bytes + (asked + alignment - 1) / alignment * alignment;
    if (takes < head_bytes || takes > size - at) return false;
    at += takes;
  }
  return true;
}

std::string path_of(const Handle& object, const std::string& place) {
  const ssize_t length = H5Fget_name(object.id(), nullptr, 0);
  check(length, place);
  std::string path(static_cast<std::size_t>(length) + 1, '\0');
  check(H5Fget_name(object.id(), path.data(), path.size()), place);
  path.resize(static_cast<std::size_t>(length));
  return path;
}

unsigned long number_of_file(const Handle& object, const std::string& place) {
  H5O_info_t info;
  check(H5Oget_info2(object.id(), &info, H5O_INFO_BASIC), place);
  return info.fileno;
}

}  // namespace

void check_global_heaps(const Handle& object, const std::string& place) {
  // A file that is opened anew has a new number.
  thread_local unsigned long found_sound = 0;
  const unsigned long number = number_of_file(object, place);
  if (number == found_sound) return;
  const MappedFile file(path_of(object, place));
  const std::string_view bytes = file.bytes();
  if (bytes.empty()) throw FileFailure(IoErrc::bad_data, place + ": cannot be read again");
  for (std::size_t at = bytes.find(collection_head); at != std::string_view::npos;
       at = bytes.find(collection_head, at + 1)) {
    if (is_sound(bytes.substr(at))) continue;
    throw FileFailure(IoErrc::bad_data, place + ": damaged: a heap of texts at byte " +
                                            std::to_string(at) +
                                            " holds more than it has room for");
  }
  found_sound = number;
}

}  // namespace rvbench::hal::hdf5
