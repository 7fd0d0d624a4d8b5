#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "hal/formats/uff_datasets.hpp"
#include "hal/types/frequency_response.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// One axis of a function: what it is of, by code and in words.
struct UffAxis {
  int quantity = 0;   ///< 8 displacement, 11 velocity, 12 acceleration, 17 time, 18 frequency ...
  std::string label;  ///< "Acceleration"; empty for NONE
  std::string unit;   ///< as the file spells it; empty for NONE
};

/// What a function is of, by the code in its data set.
enum class UffFunctionType { time_response = 1, frequency_response = 4, coherence = 6 };

/// Data set 58 or 58b: function at a nodal degree of freedom, values as they are in the file.
struct UffFunction {
  std::size_t line = 0;                 ///< of the data set's number
  std::array<std::string, 5> id_lines;  ///< free text; empty for NONE
  int type = 0;                         ///< UffFunctionType, and many more
  DegreeOfFreedom response;
  DegreeOfFreedom reference;
  bool is_complex = false;
  double first = 0;            ///< abscissa of values[0]
  std::optional<double> step;  ///< of the abscissa; nothing if it is uneven
  UffAxis abscissa;
  UffAxis numerator;  ///< the ordinate's, or what is divided
  UffAxis denominator;
  int declared = 0;         ///< values, by the header
  Eigen::VectorXcd values;  ///< those that are there, `declared` at most; NaN for no number
  int found = 0;            ///< values in the file: fewer, or more, than declared

  bool is(UffFunctionType wanted) const { return type == static_cast<int>(wanted); }
  bool is_whole() const { return found == declared; }
};

/// Parses a data set 58 or 58b. Errors name the line and column at fault.
Result<UffFunction> read_uff_function(const std::filesystem::path& file, const UffDataset& dataset);

/// "frequency response", "power spectral density"; "function of type 99"
std::string name_of_type(int type);

/// "58 at line 120": a place in a file, for notes and errors.
std::string place_of(const UffFunction& function);

}  // namespace rvbench::hal::formats
