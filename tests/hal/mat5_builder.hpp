#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace rvbench::test {

/// MAT v5 files byte by byte ("MAT-File Format", level 5), so that they can also be wrong.
inline std::string mat5_word(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

inline std::string mat5_element(std::uint32_t type, std::string data) {
  const std::string tag = mat5_word(type) + mat5_word(static_cast<std::uint32_t>(data.size()));
  data.resize((data.size() + 7) / 8 * 8);
  return tag + data;
}

/// An array of doubles that says it has rows x columns values, column by column.
inline std::string mat5_array(const std::string& name, int rows, int columns,
                              const std::vector<double>& values) {
  std::string data(values.size() * sizeof(double), '\0');
  if (!values.empty()) std::memcpy(data.data(), values.data(), data.size());
  return mat5_element(14, mat5_element(6, mat5_word(6) + mat5_word(0)) +
                              mat5_element(5, mat5_word(static_cast<std::uint32_t>(rows)) +
                                                  mat5_word(static_cast<std::uint32_t>(columns))) +
                              mat5_element(1, name) + mat5_element(9, data));
}

/// A column of complex doubles.
inline std::string mat5_complex_array(const std::string& name, const std::vector<double>& real,
                                      const std::vector<double>& imaginary) {
  const auto bytes_of = [](const std::vector<double>& values) {
    std::string data(values.size() * sizeof(double), '\0');
    std::memcpy(data.data(), values.data(), data.size());
    return mat5_element(9, data);
  };
  constexpr std::uint32_t complex_doubles = 0x800 + 6;
  return mat5_element(
      14, mat5_element(6, mat5_word(complex_doubles) + mat5_word(0)) +
              mat5_element(5, mat5_word(static_cast<std::uint32_t>(real.size())) + mat5_word(1)) +
              mat5_element(1, name) + bytes_of(real) + bytes_of(imaginary));
}

/// A variable of any class, 1 x 1 unless stated, that holds these elements.
inline std::string mat5_variable(std::uint32_t class_and_flags, const std::string& name,
                                 const std::string& content, std::uint32_t rows = 1,
                                 std::uint32_t columns = 1) {
  return mat5_element(14, mat5_element(6, mat5_word(class_and_flags) + mat5_word(0)) +
                              mat5_element(5, mat5_word(rows) + mat5_word(columns)) +
                              mat5_element(1, name) + content);
}

/// Text in UTF-8, of so many UTF-16 units.
inline std::string mat5_text(const std::string& name, const std::string& text,
                             std::uint32_t units) {
  return mat5_variable(4, name, mat5_element(16, text), 1, units);
}

/// Names of so many bytes each; all of up to four bytes lie inside their tag, as MATLAB writes
/// them.
inline std::string mat5_structure(const std::string& name, std::uint32_t name_bytes,
                                  const std::vector<std::string>& fields,
                                  const std::vector<std::string>& members) {
  std::string names;
  for (const std::string& field : fields) {
    names += field;
    names.resize((names.size() + name_bytes - 1) / name_bytes * name_bytes);
  }
  const auto size = static_cast<std::uint32_t>(names.size());
  std::string inside = names;
  inside.resize(4);
  const std::string tagged =
      size <= 4 ? mat5_word(size << 16U | 1U) + inside : mat5_element(1, names);
  std::string content = mat5_word(4U << 16U | 5U) + mat5_word(name_bytes) + tagged;
  for (const std::string& member : members) content += member;
  return mat5_variable(2, name, content);
}

inline std::string mat5_file(const std::vector<std::string>& variables) {
  std::string file = "MATLAB 5.0 MAT-file";
  file.resize(124, ' ');
  file += std::string("\0\x01IM", 4);
  for (const std::string& variable : variables) file += variable;
  return file;
}

}  // namespace rvbench::test
