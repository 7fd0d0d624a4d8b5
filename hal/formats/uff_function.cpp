#include "hal/formats/uff_function.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "hal/formats/even_grid.hpp"
#include "hal/formats/fixed_columns.hpp"
#include "hal/formats/foreign_file.hpp"
#include "hal/formats/si_unit.hpp"
#include "hal/formats/uff_values.hpp"

namespace rvbench::hal::formats {
namespace {

using Fault = std::optional<std::string>;

// Header lines of one data set, with their numbers in the file.
struct Header {
  std::string_view rest;
  std::size_t line;  // of what `next` gives
  std::string_view next() {
    ++line;
    return take_line(rest);
  }
};

// What a field needs to be read: its line, and where in it.
struct Field {
  std::string_view line;
  std::size_t number;

  Fault take(std::size_t first, std::size_t count, int& value) const {
    const Columns field = columns(line, first, count);
    const std::optional<int> read = field.integer();
    if (!read) return fault(first, field);
    value = *read;
    return std::nullopt;
  }
  Fault take(std::size_t first, std::size_t count, double& value) const {
    const Columns field = columns(line, first, count);
    const std::optional<double> read = field.number();
    if (!read || !std::isfinite(*read)) return fault(first, field);
    value = *read;
    return std::nullopt;
  }
  Fault fault(std::size_t first, const Columns& field) const {
    return fmt::format("{}:{}: \"{}\" is not a number", number, first + 1, said_in(field.text()));
  }
};

// 1 = +X, -1 = -X, 2, 3, 4 = +RX ...; nothing for 0, a scalar.
std::string direction_of(int code) {
  const int axis = std::abs(code) - 1;
  if (code < -6 || code > 6 || code == 0) return {};
  return fmt::format("{}{}{}", code > 0 ? '+' : '-', axis >= 3 ? "R" : "", "XYZ"[axis % 3]);
}

DegreeOfFreedom place(std::string_view entity, int node, int direction) {
  const std::string name(said_in(entity));
  std::string point = name;
  if (node != 0) point = name.empty() ? std::to_string(node) : fmt::format("{}:{}", name, node);
  return {point, direction_of(direction)};
}

Fault read_places(const Field& field, UffFunction& function) {
  int node = 0, direction = 0, reference_node = 0, reference_direction = 0;
  if (auto fault = field.take(0, 5, function.type)) return fault;
  if (auto fault = field.take(41, 10, node)) return fault;
  if (auto fault = field.take(51, 4, direction)) return fault;
  if (auto fault = field.take(66, 10, reference_node)) return fault;
  if (auto fault = field.take(76, 4, reference_direction)) return fault;
  function.response = place(columns(field.line, 31, 10).text(), node, direction);
  function.reference =
      place(columns(field.line, 56, 10).text(), reference_node, reference_direction);
  return std::nullopt;
}

// How the numbers behind the header are to be taken.
struct Shape {
  bool is_double = false;
  bool has_abscissa = false;
};

Fault read_shape(const Field& field, UffFunction& function, Shape& shape) {
  int data_type = 0, is_even = 0;
  double step = 0;
  if (auto fault = field.take(0, 10, data_type)) return fault;
  if (auto fault = field.take(10, 10, function.declared)) return fault;
  if (auto fault = field.take(20, 10, is_even)) return fault;
  if (auto fault = field.take(30, 13, function.first)) return fault;
  if (auto fault = field.take(43, 13, step)) return fault;
  if (data_type != 2 && data_type != 4 && data_type != 5 && data_type != 6) {
    return fmt::format("{}: data type {}, not 2, 4 (real), 5 or 6 (complex)", field.number,
                       data_type);
  }
  if (function.declared < 0) {
    return fmt::format("{}: {} values", field.number, function.declared);
  }
  function.is_complex = data_type >= 5;
  shape = {data_type == 4 || data_type == 6, is_even != 1};
  if (shape.has_abscissa) return std::nullopt;
  if (!(step > least_step)) return fmt::format("{}: abscissa in steps of {}", field.number, step);
  function.step = step;
  return std::nullopt;
}

Fault read_axis(const Field& field, UffAxis& axis) {
  if (auto fault = field.take(0, 10, axis.quantity)) return fault;
  axis.label = said_in(columns(field.line, 26, 20).text());
  axis.unit = said_in(columns(field.line, 47, 20).text());
  return std::nullopt;
}

Fault read_header(Header& header, UffFunction& function, Shape& shape) {
  const auto next = [&header] {
    const std::string_view line = header.next();
    return Field{line, header.line};
  };
  for (std::string& text : function.id_lines) text = said_in(header.next());
  if (auto fault = read_places(next(), function)) return fault;
  if (auto fault = read_shape(next(), function, shape)) return fault;
  if (auto fault = read_axis(next(), function.abscissa)) return fault;
  if (auto fault = read_axis(next(), function.numerator)) return fault;
  if (auto fault = read_axis(next(), function.denominator)) return fault;
  header.next();  // the z axis
  return std::nullopt;
}

void take_values(const std::vector<double>& numbers, const Shape& shape, UffFunction& function) {
  const std::size_t offset = shape.has_abscissa ? 1 : 0;
  const std::size_t stride = offset + (function.is_complex ? 2 : 1);
  const std::size_t there = numbers.size() / stride;
  const auto taken = std::min(there, static_cast<std::size_t>(function.declared));
  function.found = static_cast<int>(there);
  function.values.resize(static_cast<Eigen::Index>(taken));
  Eigen::VectorXd abscissa(function.values.size());
  for (std::size_t i = 0; i < taken; ++i) {
    const double* value = numbers.data() + i * stride;
    const auto at = static_cast<Eigen::Index>(i);
    abscissa[at] = value[0];
    function.values[at] = {value[offset], function.is_complex ? value[offset + 1] : 0.0};
  }
  if (!shape.has_abscissa || taken == 0) return;
  function.first = abscissa[0];
  function.step = even_step(abscissa);
}

}  // namespace

Result<UffFunction> read_uff_function(const std::filesystem::path& file,
                                      const UffDataset& dataset) {
  UffFunction function;
  function.line = dataset.line;
  Header header{dataset.body, dataset.line};
  Shape shape;
  if (const Fault fault = read_header(header, function, shape)) return bad_file(file, *fault);
  const auto numbers = uff_numbers(dataset, header.rest, header.line + 1, shape.is_double);
  if (const auto* fault = std::get_if<std::string>(&numbers)) return bad_file(file, *fault);
  take_values(std::get<0>(numbers), shape, function);
  return function;
}

std::string name_of_type(int type) {
  static const std::map<int, std::string> names = {{0, "general function"},
                                                   {1, "time response"},
                                                   {2, "auto spectrum"},
                                                   {3, "cross spectrum"},
                                                   {4, "frequency response"},
                                                   {5, "transmissibility"},
                                                   {6, "coherence"},
                                                   {7, "auto correlation"},
                                                   {8, "cross correlation"},
                                                   {9, "power spectral density"},
                                                   {10, "energy spectral density"},
                                                   {11, "probability density"},
                                                   {12, "spectrum"},
                                                   {18, "mode indicator function"},
                                                   {24, "shock response spectrum"},
                                                   {26, "multiple coherence"},
                                                   {27, "order function"}};
  const auto found = names.find(type);
  return found == names.end() ? fmt::format("function of type {}", type) : found->second;
}

std::string place_of(const UffFunction& function) {
  return fmt::format("58 at line {}", function.line);
}

}  // namespace rvbench::hal::formats
