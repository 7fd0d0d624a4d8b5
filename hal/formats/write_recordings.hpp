#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "hal/formats/writer.hpp"

namespace rvbench::hal {

/// A file that was written, and what it had no place for.
struct WrittenFile {
  std::filesystem::path file;
  std::size_t channels = 0;  ///< of all its recordings
  std::vector<std::string> warnings;
};

/// Writes recordings in a format: into `file`, if that can hold them all, else into files beside it
/// that are named after it: "a_012.wav" of point 12 or, where it has several sample clocks,
/// "a_012_1.wav" and "a_012_2.wav"; "a_1.wav" of the only point. Each appears whole or not at all;
/// none is begun if the name of one is taken. Control characters in names and other text are
/// written as ?, with a warning.
///
/// Errors  "<file>: <what>": a name is taken and `overwrite` is false, the folder may not be
///         written, the disk is full (refused); "<source>: <what>": a channel has no rate, the
///         format cannot hold a value (bad_data)
/// @throws std::invalid_argument: no recording, or one without samples
Result<std::vector<WrittenFile>> write_recordings(const std::vector<Recording>& recordings,
                                                  const std::filesystem::path& file,
                                                  const formats::Writer& writer, bool overwrite);

}  // namespace rvbench::hal
