#pragma once

#include <filesystem>
#include <vector>

#include "hal/formats/table/table_hints.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// Relative: speeds that differ by less are one; a motor's slip may be left out of a nominal one.
inline constexpr double speed_tolerance = 1e-2;

/// What the user knows about a file. It goes before what the file says; a note tells if the two
/// differ, rates by more than 0.1 % or speeds by more than 1 %. Speeds that differ by more than a
/// motor's slip are an error, unless the file has the shaft's angle.
struct RecordingHints {
  double rate_Hz = not_known;
  double speed_rpm = not_known;
  formats::TableHints table = {};  ///< of tables in text; others have no use for it
};

/// Reads a recording of any supported format, chosen by content, then by extension: rvbench's own
/// HDF5, MAT v5 and v7.3 (numeric arrays), TDMS, WAV, FLAC, UFF (time responses of 58 and 58b),
/// CSV.
///
/// Rate     of channels is 0 if neither file nor hints give it: it is never guessed, ask the user
/// Units    SI where they are known, with a note of what values were multiplied by; else as the
///          file says, "" if it says none
/// Samples  NaN where the file says so, or an infinity: a lost sample
/// Status   "ok"; "INVALID: ..." where the file holds other counts than it declares
/// Errors   "<file>: <variable or line:column>: <what>"; at least one recording with samples
///          otherwise. @throws std::invalid_argument if a hint is not above 0
Result<std::vector<Recording>> read_recordings(const std::filesystem::path& file,
                                               const RecordingHints& hints = {});

}  // namespace rvbench::hal
