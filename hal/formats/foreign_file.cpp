#include "hal/formats/foreign_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace rvbench::hal::formats {

std::optional<IoError> find_obstacle(const std::filesystem::path& file) {
  const auto because = [&file](IoErrc code, const std::string& why) {
    return IoError{code, file.string() + ": " + why};
  };
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return because(IoErrc::disconnected, error && status.type() == std::filesystem::file_type::none
                                             ? error.message()
                                             : "no such file");
  }
  if (std::filesystem::is_directory(status)) return because(IoErrc::refused, "is a folder");
  if (!std::filesystem::is_regular_file(status)) return because(IoErrc::refused, "is no file");
  if (!std::ifstream(file)) return because(IoErrc::refused, std::strerror(errno));
  if (std::filesystem::file_size(file, error) == 0) return bad_file(file, "is empty");
  return std::nullopt;
}

std::string head_of(const std::filesystem::path& file) {
  std::string head(4096, '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(stream.gcount()));
  return head;
}

std::string bytes_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::string bytes(error ? 0 : static_cast<std::size_t>(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(stream.gcount()));
  return bytes;
}

std::vector<Recording> alone(Recording&& recording) {
  std::vector<Recording> recordings;
  recordings.push_back(std::move(recording));
  return recordings;
}

IoError bad_file(const std::filesystem::path& file, const std::string& what) {
  return IoError{IoErrc::bad_data, file.string() + ": " + what};
}

}  // namespace rvbench::hal::formats
