#include "hal/formats/uff_values.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "hal/formats/byte_reader.hpp"
#include "hal/formats/fixed_columns.hpp"
#include "hal/formats/si_unit.hpp"

namespace rvbench::hal::formats {
namespace {

using Numbers = std::variant<std::vector<double>, std::string>;

// The last token of a file that was cut off may be a part of a number only: it is left out.
std::string_view without_last_token(std::string_view text) {
  const std::size_t blank = text.find_last_of(" \t\r\n");
  return blank == std::string_view::npos ? std::string_view() : text.substr(0, blank);
}

Numbers numbers_of_text(std::string_view text, std::size_t line, bool is_cut) {
  if (is_cut) text = without_last_token(text);
  std::vector<double> numbers;
  for (; !text.empty(); ++line) {
    std::string_view rest = take_line(text);
    while (!said_in(rest).empty()) {
      const std::optional<double> number = take_fortran_number(rest);
      if (!number) return fmt::format("{}: \"{}\" is not a number", line, rest.substr(0, 40));
      numbers.push_back(*number);
    }
  }
  return numbers;
}

template <typename Number>
std::vector<double> numbers_of_bytes(std::string_view bytes, std::endian order) {
  std::vector<double> numbers(bytes.size() / sizeof(Number));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = number_at<Number>(bytes.data() + i * sizeof(Number), order);
    numbers[i] = std::isfinite(number) ? static_cast<double>(number)
                                       : std::numeric_limits<double>::quiet_NaN();
  }
  return numbers;
}

Numbers numbers_of_binary(const UffDataset& dataset, std::string_view bytes, bool is_double) {
  const auto field = [&dataset](std::size_t first, std::size_t count) {
    return columns(dataset.heading, first, count).integer().value_or(-1);
  };
  const int order = field(7, 6), format = field(13, 6), size = field(31, 12);
  if (order != 1 && order != 2) {
    return fmt::format("{}: byte order {}, not 1 (little) or 2 (big)", dataset.line, order);
  }
  if (format == 1) return fmt::format("{}: VAX floating point is not read", dataset.line);
  if (format == 3) return fmt::format("{}: IBM floating point is not read", dataset.line);
  if (format != 2) return fmt::format("{}: floating point format {}", dataset.line, format);
  if (size < 0) return fmt::format("{}: no number of bytes", dataset.line);
  bytes = bytes.substr(0, static_cast<std::size_t>(size));
  const std::endian endian = order == 1 ? std::endian::little : std::endian::big;
  return is_double ? numbers_of_bytes<double>(bytes, endian)
                   : numbers_of_bytes<float>(bytes, endian);
}

}  // namespace

Numbers uff_numbers(const UffDataset& dataset, std::string_view values, std::size_t first_line,
                    bool is_double) {
  if (dataset.is_binary) return numbers_of_binary(dataset, values, is_double);
  return numbers_of_text(values, first_line, !dataset.is_closed);
}

}  // namespace rvbench::hal::formats
