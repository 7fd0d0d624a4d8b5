#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace rvbench::bench {

/// What a recording is, to whoever asks before it is judged.
struct RecordingFacts {
  std::string summary;  ///< "CSV, 2 channels (a [m/s²], b), 8000 samples at 2000 Hz: 4 s"
  std::vector<std::string> notes;     ///< how it was read, and what nobody would ask of it
  std::vector<std::string> warnings;  ///< for what it, or a channel, would not be judged
};

/// Whether a file is to be read as a recording; what begins as JSON, or is called so, is none.
bool is_recording(const std::filesystem::path& file);

/// Reads a file that is_recording(); of several recordings in it the first is told.
/// @return why it cannot be read: "<file>: <place>: <what>"
std::variant<RecordingFacts, std::string> recording_facts(const std::filesystem::path& file);

}  // namespace rvbench::bench
