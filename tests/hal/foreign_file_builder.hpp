#pragma once

#include <fmt/format.h>

#include <bit>
#include <catch2/catch.hpp>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "hal/formats/read_recordings.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::test {

inline std::filesystem::path written(const ScratchFolder& scratch, const std::string& name,
                                     const std::string& bytes) {
  std::ofstream(scratch / name, std::ios::binary) << bytes;
  return scratch / name;
}

/// What is read of these bytes in a file of that name; fails with the reason where nothing is.
inline std::vector<Recording> recordings_in(const std::string& name, const std::string& bytes) {
  const ScratchFolder scratch;
  auto read = hal::read_recordings(written(scratch, name, bytes));
  if (!read) FAIL(read.error().where);
  return std::move(read).value();
}

/// Why they are refused.
inline std::string complaint_of(const std::string& name, const std::string& bytes) {
  const ScratchFolder scratch;
  const auto read = hal::read_recordings(written(scratch, name, bytes));
  REQUIRE_FALSE(read);
  return read.error().where;
}

/// The bytes of a number, in the order asked for.
template <typename Number>
std::string packed(Number number, std::endian order = std::endian::little) {
  std::string bytes(sizeof(Number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(Number));
  return order == std::endian::native ? bytes : std::string(bytes.rbegin(), bytes.rend());
}

/// A data set 58 or 58b; what is not set is as a program would write that knows nothing of it.
struct Uff58 {
  int type = 4;
  std::string response = "NONE", reference = "NONE";
  int response_node = 3, response_direction = 3;
  int reference_node = 10, reference_direction = -3;
  int data_type = 5;  ///< 2 real, 4 real double, 5 complex, 6 complex double
  int declared = 2;
  bool is_even = true;
  double first = 0, step = 1;
  int abscissa = 18;
  std::string abscissa_unit = "Hz";
  int over = 12, under = 13;
  std::string over_unit = "m/s^2", under_unit = "N";
  std::string date = "NONE";
  std::string newline = "\n";
  std::string values;  ///< as text, or as bytes of a binary one

  std::string header() const {
    const auto axis = [&](int code, const std::string& unit) {
      return fmt::format("{:10}{:5}{:5}{:5} {:20} {:20}", code, 0, 0, 0, "NONE", unit) + newline;
    };
    return "title" + newline + "NONE" + newline + date + newline + "NONE" + newline + "NONE" +
           newline +
           fmt::format("{:5}{:10}{:5}{:10} {:10}{:10}{:4} {:10}{:10}{:4}", type, 0, 0, 0, response,
                       response_node, response_direction, reference, reference_node,
                       reference_direction) +
           newline +
           fmt::format("{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}", data_type, declared,
                       is_even ? 1 : 0, first, step, 0.0) +
           newline + axis(abscissa, abscissa_unit) + axis(over, over_unit) +
           axis(under, under_unit) + axis(0, "NONE");
  }
  std::string ascii() const {
    return "    -1" + newline + "    58" + newline + header() + values + newline + "    -1" +
           newline;
  }
  /// @param order  1 little, 2 big  @param format  1 VAX, 2 IEEE, 3 IBM
  std::string binary(int order, int format = 2) const {
    return "    -1" + newline +
           fmt::format("    58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}", order, format, 11,
                       values.size(), 0, 0, 0, 0) +
           newline + header() + values + newline + "    -1" + newline;
  }
};

inline std::string uff_set(int number, const std::string& lines) {
  return fmt::format("    -1\n{:6}\n{}    -1\n", number, lines);
}

/// A chunk of a RIFF file that declares `declared` bytes, or as many as it has.
inline std::string riff_chunk(const std::string& name, const std::string& body,
                              std::int64_t declared = -1) {
  const auto size = declared < 0 ? body.size() : static_cast<std::size_t>(declared);
  return name + packed(static_cast<std::uint32_t>(size)) + body;
}

}  // namespace rvbench::test
