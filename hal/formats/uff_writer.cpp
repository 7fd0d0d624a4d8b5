#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

#include "hal/formats/byte_writer.hpp"
#include "hal/formats/start_time.hpp"
#include "hal/formats/writer.hpp"

// Source  SDRC, Universal File Formats; University of Cincinnati, SDRL, "Universal File Formats":
//         data sets 58 and 164
namespace rvbench::hal::formats {
namespace {

constexpr int time_response = 1, real_double = 4, even = 1;
constexpr std::size_t most_in_place = 10, most_in_axis = 20, most_in_line = 80;
constexpr std::string_view status_word = "rvbench_status=";
constexpr int numbers_per_line = 4;

// What an axis is of: its code, and the exponents of length and force in its unit.
struct Quantity {
  std::string_view symbol;  // as in ChannelInfo
  std::string_view spelt;   // in the file
  int code, length, force;
};
constexpr std::array quantities = {
    Quantity{"m/s²", "m/s^2", 12, 1, 0}, Quantity{"m/s", "m/s", 11, 1, 0},
    Quantity{"m", "m", 8, 1, 0},         Quantity{"N", "N", 13, 0, 1},
    Quantity{"N·m", "N*m", 0, 1, 1},     Quantity{"Pa", "Pa", 15, -2, 1},
    Quantity{"°C", "degC", 5, 0, 0},     Quantity{"rad/s²", "rad/s^2", 0, 0, 0}};

Quantity quantity_of(const std::string& unit) {
  for (const Quantity& quantity : quantities) {
    if (quantity.symbol == unit) return quantity;
  }
  return {unit, unit.empty() ? "NONE" : std::string_view(unit), 0, 0, 0};
}

// 1 = +X, -1 = -X, 2, 3, 4 = +RX ...; 0 for what is no such direction.
int code_of(const std::string& direction) {
  for (int axis = 0; axis < 6; ++axis) {
    for (const int sign : {1, -1}) {
      const std::string text =
          fmt::format("{}{}{}", sign > 0 ? '+' : '-', axis >= 3 ? "R" : "", "XYZ"[axis % 3]);
      if (text == direction) return sign * (axis + 1);
    }
  }
  return 0;
}

// Columns count bytes, not characters.
std::string padded(std::string text, std::size_t bytes) {
  text.resize(std::max(text.size(), bytes), ' ');
  return text;
}

std::string axis_line(int code, int length, int force, std::string_view label,
                      std::string_view unit) {
  return fmt::format("{:10}{:5}{:5}{:5} {} {}\n", code, length, force, 0,
                     padded(std::string(label), most_in_axis),
                     padded(std::string(unit), most_in_axis));
}

// What a line of text holds; one line must stay one, and a character whole.
std::string id_line(const std::string& text) {
  std::size_t end = std::min(text.size(), most_in_line);
  while (end > 0 && end < text.size() && (text[end] & '\xC0') == '\x80') --end;
  return (end == 0 ? "NONE" : text.substr(0, end)) + '\n';
}

// What is known of all, as text of two lines: the second has what the first has no room for.
std::array<std::string, 2> facts_lines(const Recording& recording) {
  std::array<std::string, 2> lines;
  const auto add = [&lines](const char* what, double value) {
    if (!std::isfinite(value)) return;
    const std::string text = fmt::format("{}={}", what, value);
    const bool has_room = lines[0].size() + 1 + text.size() <= most_in_line;
    std::string& line = has_room && lines[1].empty() ? lines[0] : lines[1];
    line += (line.empty() ? "" : " ") + text;
  };
  add("speed_rpm", recording.speed_rpm);
  add("load_pct", recording.load_pct);
  add("torque_Nm", recording.torque_Nm);
  if (recording.repeat > 0) add("repeat", recording.repeat);
  add("planned_speed_rpm", recording.planned_speed_rpm);
  return lines;
}

// The first ten bytes of the name tell the place; the first line of text tells all of it.
std::string header_of(const Recording& recording, const Channel& channel) {
  const std::string& name = channel.info.name;
  const Quantity quantity = quantity_of(channel.info.unit);
  const double start_utc_s = noted_start_s(recording);
  const auto [facts, more_facts] = facts_lines(recording);
  std::string lines = id_line(name) + id_line(more_facts) + id_line(uff_date(start_utc_s)) +
                      id_line(facts) + id_line(std::string(status_word) + recording.status);
  lines += fmt::format("{:5}{:10}{:5}{:10} {}{:10}{:4} {:10}{:10}{:4}\n", time_response, 0, 0, 0,
                       padded(name.size() <= most_in_place ? name : "NONE", most_in_place), 0,
                       code_of(channel.info.direction), "NONE", 0, 0);
  lines += fmt::format("{:10}{:10}{:10}{:13.6E}{:13.6E}{:13.6E}\n", real_double,
                       channel.samples.size(), even, channel.start_s, 1 / channel.rate_Hz, 0.0);
  lines += axis_line(17, 0, 0, "Time", "s");
  lines += axis_line(quantity.code, quantity.length, quantity.force, "NONE",
                     quantity.spelt.substr(0, most_in_axis));
  return lines + axis_line(0, 0, 0, "NONE", "NONE") + axis_line(0, 0, 0, "NONE", "NONE");
}

// SI: metre, newton; temperatures in kelvin, relative ones in °C.
std::string units() {
  return "    -1\n   164\n" + fmt::format("{:10}{:20}{:10}\n", 1, "SI: Meter (newton)", 2) +
         "  1.0000000000000000D+00  1.0000000000000000D+00  1.0000000000000000D+00\n"
         "  2.7315000000000000D+02\n    -1\n";
}

std::string numbers_as_text(const Eigen::VectorXd& samples) {
  std::string text;
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    fmt::format_to(std::back_inserter(text), "{:20.12E}", samples[i]);
    if ((i + 1) % numbers_per_line == 0 || i + 1 == samples.size()) text += '\n';
  }
  return text;
}

std::string numbers_as_bytes(const Eigen::VectorXd& samples) {
  std::string bytes;
  for (const double sample : samples) put(bytes, sample);
  return bytes;
}

// What has no place in a data set and must not be cut; empty if all has.
std::string fault_of(const Channel& channel) {
  constexpr Eigen::Index most_samples = std::numeric_limits<std::int32_t>::max() / 8;
  if (channel.samples.size() > most_samples) return "more samples than a universal file can count";
  if (channel.info.name.size() > most_in_line) return "a name of more than 80 bytes";
  if (quantity_of(channel.info.unit).spelt.size() > most_in_axis) {
    return "its unit has more than 20 bytes";
  }
  return "";
}

// Of a binary set: little endian, IEEE 754, eleven lines before the bytes.
std::string binary_heading(std::size_t bytes) {
  return fmt::format("    58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}\n", 1, 2, 11, bytes, 0, 0, 0, 0);
}

Status write_sets(const std::vector<Recording>& recordings, FileDraft& draft, bool is_binary) {
  if (Status written = draft.write(units()); !written) return written;
  for (const Channel& channel : recordings.front().channels) {
    if (const std::string fault = fault_of(channel); !fault.empty()) {
      return IoError{IoErrc::bad_data, draft.file().string() + ": " + channel.info.name + ": " +
                                           fault + ": write HDF5 or TDMS instead"};
    }
    const std::string values =
        is_binary ? numbers_as_bytes(channel.samples) + '\n' : numbers_as_text(channel.samples);
    const std::string heading = is_binary ? binary_heading(values.size() - 1) : "    58\n";
    for (const std::string& part : {"    -1\n" + heading, header_of(recordings.front(), channel),
                                    values, std::string("    -1\n")}) {
      if (Status written = draft.write(part); !written) return written;
    }
  }
  return Done{};
}

constexpr Holds holds{.clocks = true,
                      .any_direction = false,
                      .sensitivities = false,
                      .status_bytes = most_in_line - status_word.size(),
                      .time_digits = 7};

}  // namespace

Writer uff58_writer() {
  return {"uff58", "UFF 58", {".uff", ".unv"}, holds, [](const auto& recordings, FileDraft& draft) {
            return write_sets(recordings, draft, false);
          }};
}

Writer uff58b_writer() {
  return {"uff58b", "UFF 58b", {".uffb"}, holds, [](const auto& recordings, FileDraft& draft) {
            return write_sets(recordings, draft, true);
          }};
}

}  // namespace rvbench::hal::formats
