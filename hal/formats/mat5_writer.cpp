#include <fmt/format.h>

#include <cstdint>
#include <limits>

#include "hal/formats/byte_writer.hpp"
#include "hal/formats/mat_header.hpp"
#include "hal/formats/mat_structure.hpp"
#include "hal/formats/utf16.hpp"
#include "hal/formats/writer.hpp"

// Source  "MAT-File Format", The MathWorks, level 5
namespace rvbench::hal::formats {
namespace {

enum Type : std::uint32_t { int8 = 1, int32 = 5, uint32 = 6, float64 = 9, matrix = 14, utf16 = 17 };
enum Class : std::uint32_t { structure_class = 2, char_class = 4, double_class = 6 };

constexpr std::size_t field_bytes = 32;  // a field's name, ended by 0
constexpr std::uint16_t mat5_version = 0x0100;

std::string element(Type type, std::string data) {
  std::string bytes;
  put(bytes, static_cast<std::uint32_t>(type));
  put(bytes, static_cast<std::uint32_t>(data.size()));
  data.resize((data.size() + 7) / 8 * 8);
  return bytes + data;
}

// What every array begins with.
std::string head_of(Class kind, const std::string& name, std::size_t rows, std::size_t columns) {
  std::string flags, size;
  put(flags, static_cast<std::uint32_t>(kind));
  put(flags, std::uint32_t{0});
  put(size, static_cast<std::int32_t>(rows));
  put(size, static_cast<std::int32_t>(columns));
  return element(uint32, flags) + element(int32, size) + element(int8, name);
}

std::string array_of(const Eigen::MatrixXd& values) {
  std::string numbers;
  numbers.reserve(static_cast<std::size_t>(values.size()) * sizeof(double));
  for (const double value : values.reshaped()) put(numbers, value);
  return element(matrix, head_of(double_class, "", static_cast<std::size_t>(values.rows()),
                                 static_cast<std::size_t>(values.cols())) +
                             element(float64, numbers));
}

std::string array_of(const std::string& text) {
  const std::vector<std::uint16_t> units = utf16_of(text);
  std::string bytes;
  for (const std::uint16_t unit : units) put(bytes, unit);
  return element(
      matrix, head_of(char_class, "", units.empty() ? 0 : 1, units.size()) + element(utf16, bytes));
}

std::string array_of(const MatStructure& structure) {
  std::string names, fields;
  const auto add = [&](std::string name, const std::string& array) {
    name.resize(field_bytes);
    names += name;
    fields += array;
  };
  for (const auto& [name, text] : structure.texts) add(name, array_of(text));
  for (const auto& [name, values] : structure.numbers) add(name, array_of(values));
  std::string length;  // as a small element, as the level wants it
  put(length, std::uint16_t{int32});
  put(length, std::uint16_t{4});
  put(length, static_cast<std::int32_t>(field_bytes));
  return element(matrix, head_of(structure_class, structure.name, 1, 1) + length +
                             element(int8, names) + fields);
}

Status write_mat5(const std::vector<Recording>& recordings, FileDraft& draft) {
  constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() - 4096U;
  if (Status written = draft.write(mat_header("MATLAB 5.0 MAT-file", mat5_version)); !written) {
    return written;
  }
  for (const Channel& channel : recordings.front().channels) {
    if (static_cast<std::size_t>(channel.samples.size()) * sizeof(double) > most) {
      return IoError{IoErrc::refused,
                     fmt::format("{}: {}: more than the 2 GB that a variable of MAT v5 can have: "
                                 "write MAT v7.3 instead (--format mat73)",
                                 draft.file().string(), channel.info.name)};
    }
  }
  for (const MatStructure& structure : mat_structures(recordings.front())) {
    if (Status written = draft.write(array_of(structure)); !written) return written;
  }
  return Done{};
}

}  // namespace

Writer mat5_writer() { return {"mat5", "MAT v5", {".mat"}, {.clocks = true}, write_mat5}; }

}  // namespace rvbench::hal::formats
