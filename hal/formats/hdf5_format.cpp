#include "hal/formats/apply_units.hpp"
#include "hal/formats/format.hpp"
#include "hal/hdf5/journal.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal::formats {
namespace {

bool is_hdf5(std::string_view head) { return head.starts_with("\x89HDF\r\n\x1a\n"); }

// Of another program's file: rvbench writes SI units alone.
void take_units(Recording& recording) {
  for (Channel& channel : recording.channels) {
    const std::string unit = channel.info.unit;
    apply_unit(unit, channel, recording.notes);
  }
}

Result<std::vector<Recording>> read_hdf5(const std::filesystem::path& file, const TableHints&) {
  // After a crash the file may hold zeros where its journal has samples.
  const bool is_repaired = hdf5::is_left_behind(hdf5::journal_of(file));
  if (is_repaired) {
    if (const Status repaired = repair_recording(file); !repaired) return repaired.error();
  }
  const auto opened = RecordingReader::open(file);
  if (!opened) return opened.error();
  RecordingReader& reader = *opened.value();
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < reader.layout().points.size(); ++i) {
    Result<Recording> point = reader.read(static_cast<int>(i));
    if (!point) return point.error();
    recordings.push_back(std::move(point).value());
    if (reader.layout().software.empty()) take_units(recordings.back());
    if (is_repaired)
      recordings.back().notes.push_back("made anew: whoever recorded it was cut off");
  }
  return recordings;
}

}  // namespace

Format hdf5_format() { return {"HDF5", is_hdf5, {".h5", ".hdf5"}, read_hdf5}; }

}  // namespace rvbench::hal::formats
