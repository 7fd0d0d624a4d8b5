#pragma once

#include <stop_token>
#include <string>
#include <variant>
#include <vector>

#include "hal/formats/read_recordings.hpp"
#include "hal/types/recording.hpp"

namespace rvbench::bench {

/// What the command line says about recordings.
struct JudgeInput {
  std::vector<std::string> files;
  hal::RecordingHints hints;
  std::string channel;        ///< of accelerations, this one only; empty: all
  std::stop_token stop = {};  ///< ends it between two files
};

/// Why recordings cannot be judged: wrongly asked for, or wrong themselves.
struct JudgeRefusal {
  int exit_code = 0;
  std::string reason;
};

/// Reads every file. A speed that the user gives goes before an angle that contradicts it; a note
/// of the recording tells. Refused: a rate or speed that nobody states, a channel that no file
/// has, a rate at which not even the input shaft's own order could be seen, samples beyond any
/// unit, and a time that rises unevenly.
/// @throws Interrupted
std::variant<std::vector<Recording>, JudgeRefusal> recordings_to_judge(const JudgeInput& input);

}  // namespace rvbench::bench
