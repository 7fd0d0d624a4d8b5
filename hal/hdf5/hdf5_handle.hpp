#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "hal/types/result.hpp"

namespace rvbench::hal::hdf5 {

/// A failure on its way from an HDF5 call to the room's border, where guarded() makes it an
/// IoError. Its text starts with the place inside the file: "/points/003/torque: no rate_Hz".
class FileFailure : public std::runtime_error {
 public:
  FileFailure(IoErrc code, const std::string& text) : std::runtime_error(text), code_(code) {}
  IoErrc code() const noexcept { return code_; }

 private:
  IoErrc code_;
};

/// Owns one HDF5 identifier.
class Handle {
 public:
  using Id = std::int64_t;
  using Close = int (*)(Id);

  Handle() = default;
  Handle(Id id, Close closer) : id_(id), close_(closer) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(std::exchange(other.close_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  explicit operator bool() const noexcept { return id_ >= 0; }
  Id id() const noexcept { return id_; }

  /// Closes now. False if that failed: what was still in HDF5's caches is then lost.
  bool close() noexcept {
    const Id id = std::exchange(id_, -1);
    return id < 0 || close_(id) >= 0;
  }

 private:
  Id id_ = -1;
  Close close_ = nullptr;
};

/// Readies the calling thread: HDF5 prints its errors unless told not to, thread by thread.
void prepare_thread();

/// @throws FileFailure with `place` and HDF5's innermost reason if `id` is negative
Handle own(Handle::Id id, Handle::Close close, const std::string& place);

/// @throws FileFailure with `place` and HDF5's innermost reason if `status` is negative
void check(std::int64_t status, const std::string& place);

/// File access properties that all of rvbench's files share: the newest format, which alone can
/// be written in SWMR mode and has a checksum on every piece of metadata.
Handle file_access();

/// Runs `body`, which returns a Result, and turns a FileFailure into "<file>: <place>: <reason>".
template <typename Body>
auto guarded(const std::filesystem::path& file, Body&& body) -> decltype(body()) {
  try {
    prepare_thread();
    return body();
  } catch (const FileFailure& failure) {
    return IoError{failure.code(), file.string() + ": " + failure.what()};
  }
}

}  // namespace rvbench::hal::hdf5
