#include "hal/formats/choose_format.hpp"

#include <algorithm>
#include <cctype>

#include "hal/formats/foreign_file.hpp"

namespace rvbench::hal::formats {
namespace {

std::vector<Format> known_formats() {
  return {hdf5_format(), mat5_format(), mat73_format(), tdms_format(),
          wav_format(),  flac_format(), uff_format(),   csv_format()};
}

}  // namespace

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::optional<Format> choose_format(const std::filesystem::path& file) {
  const std::string head = head_of(file);
  const std::string extension = lower_extension(file);
  const std::vector<Format> formats = known_formats();
  for (const Format& format : formats) {
    if (format.recognises(head)) return format;
  }
  for (const Format& format : formats) {
    const auto& own = format.extensions;
    if (std::find(own.begin(), own.end(), extension) != own.end()) return format;
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
