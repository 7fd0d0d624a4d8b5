#pragma once

#include <filesystem>
#include <string_view>

#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// A file that appears whole or not at all: it is written beside its place under a name that
/// nobody else has, "<file>.4711-1.part", and gets its own when it is on the disk. What was not
/// finished is gone with this object.
///
/// Order    begin() → write()* or a library that writes to path() → finish()
/// Errors   IoError "<file>: <reason>", of a full disk and of a folder that may not be written, too
class FileDraft {
 public:
  /// @param overwrite  whether a file of that name may be replaced
  FileDraft(std::filesystem::path file, bool overwrite);
  ~FileDraft();
  FileDraft(const FileDraft&) = delete;
  FileDraft& operator=(const FileDraft&) = delete;

  Status begin();                      ///< makes it, empty; path() is known from here on
  Status write(std::string_view all);  ///< appends
  /// Writes over the first bytes: of a file that a library left room in for a head.
  Status write_first(std::string_view head);
  Status finish();  ///< after this it is there, also after a power failure
  int error() const { return error_; }  ///< errno of what failed

  const std::filesystem::path& file() const { return file_; }
  const std::filesystem::path& path() const { return draft_; }  ///< where it is written

 private:
  Status failed(int error);

  std::filesystem::path file_, draft_;
  bool overwrite_;
  bool is_made_ = false;
  int descriptor_ = -1;
  int error_ = 0;
};

/// The file that a draft of this name is of, "a.csv" of "a.csv.4711-1.part"; empty if it is none.
/// A kill leaves drafts behind.
std::filesystem::path drafted_file(const std::filesystem::path& draft);

/// Why a file must not be written; nothing if it may. @param overwrite  as above
Status check_place(const std::filesystem::path& file, bool overwrite);

}  // namespace rvbench::hal::formats
