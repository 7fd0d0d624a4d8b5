#include "hal/formats/format.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::hal::formats {
namespace {

bool recognises(std::string_view head) { return head.starts_with("\x89HDF\r\n\x1a\n"); }

Result<std::vector<Recording>> read(const std::filesystem::path& file) {
  const auto opened = RecordingReader::open(file);
  if (!opened) return opened.error();
  RecordingReader& reader = *opened.value();
  std::vector<Recording> recordings;
  for (std::size_t i = 0; i < reader.layout().points.size(); ++i) {
    Result<Recording> point = reader.read(static_cast<int>(i));
    if (!point) return point.error();
    recordings.push_back(std::move(point).value());
  }
  return recordings;
}

}  // namespace

Format hdf5_format() { return {"HDF5", recognises, {".h5", ".hdf5"}, read}; }

}  // namespace rvbench::hal::formats
