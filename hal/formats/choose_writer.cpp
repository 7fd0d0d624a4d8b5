#include "hal/formats/choose_writer.hpp"

#include <algorithm>

#include "hal/formats/choose_format.hpp"

namespace rvbench::hal::formats {

std::vector<Writer> known_writers() {
  return {hdf5_writer(),  tdms_writer(), uff58_writer(), uff58b_writer(), mat5_writer(),
          mat73_writer(), wav_writer(),  flac_writer(),  csv_writer()};
}

std::optional<Writer> choose_writer(const std::filesystem::path& file, std::string_view key) {
  const std::string extension = lower_extension(file);
  for (const Writer& writer : known_writers()) {
    const bool by_extension =
        std::ranges::find(writer.extensions, extension) != writer.extensions.end();
    if (key.empty() ? by_extension : writer.key == key) return writer;
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
