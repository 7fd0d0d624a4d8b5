#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/console.hpp"
#include "hal/formats/write_recordings.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::bench {

/// The file, and the name of the point in it, of "recording.h5#012"; no name where the file has one
/// recording only. A file's own name may have a # in it.
struct PointSource {
  std::string file, point;
};
PointSource point_source(const Recording& recording);

/// Makes a recording ready to be written: without the time column that its rate is of, and with
/// channels named without a unit that their values are no longer in, which a note tells.
/// @return why it must not be: "<source>: <what>", where its times say that samples are missing
std::optional<std::string> prepare_for_writing(Recording& recording);

/// "all.h5 is what it would be made from"; "" if it is not one of these files.
std::string made_from_fault(const std::string& out, const std::vector<std::string>& files);

/// Warns of a run's events in its recording: no format has a place for them.
void tell_left_out_events(Console& console, const std::string& file);

/// Prints how files were read, each note of a file once, and which recordings are not to be
/// trusted.
void tell_notes_of(Console& console, const std::vector<Recording>& recordings);

/// Prints what was written on `out`, and each thing that was lost once on `err`.
void tell_written(Console& console, const std::vector<hal::WrittenFile>& files);

/// Prints why nothing was written. @return the exit code: data are at fault, or the place
int refuse_writing(Console& console, const std::string& command, const IoError& error);

}  // namespace rvbench::bench
