#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "bench/command.hpp"
#include "bench/sound_units.hpp"

namespace rvbench::bench {

/// The sound units that --sound names.
struct SoundWords {
  std::vector<std::string> words;
  std::filesystem::path runs;  ///< folder of the runs, where serials are looked for
  std::string machine;         ///< that they must be of
  /// Judges a recording, or says why it cannot be read.
  std::function<std::variant<Judgement, std::string>(const std::filesystem::path& file)> judge;
};

/// Reads or judges them, and tells on standard error which do not count.
/// @return the units that count, or the exit code of what was told
std::variant<SoundUnits, int> sound_units(Console& console, const SoundWords& given);

}  // namespace rvbench::bench
