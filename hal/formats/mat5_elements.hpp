#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

/// The elements that a MAT v5 file is made of.
/// Source  "MAT-File Format", The MathWorks, level 5
namespace rvbench::hal::formats::mat5 {

enum Type : std::uint32_t {
  int8 = 1,
  uint16 = 4,
  int32 = 5,
  uint32 = 6,
  float64 = 9,
  last_number_type = 13,
  matrix = 14,
  compressed = 15,
  utf8 = 16
};
enum Class : std::uint32_t {
  cell = 1,
  structure = 2,
  object = 3,
  text = 4,
  sparse = 5,
  first_number = 6,
  last_number = 15,
  function_handle = 16,
  opaque = 17
};

/// What is wrong with an element; visit_mat5() turns it into its answer.
struct Fault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Bytes of one value of a numeric type; 0 if the type is none.
std::size_t value_bytes(std::uint32_t type);

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
};

/// The elements in a stretch of bytes, one after the other.
class Elements {
 public:
  /// @param swapped  written by a machine of the other order of bytes
  Elements(std::string_view bytes, bool swapped) : bytes_(bytes), swapped_(swapped) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t at() const { return at_; }

  /// @throws Fault if it does not lie within the bytes
  Element next();
  /// @throws Fault likewise, or if the next one is of another type
  Element expect(std::uint32_t type, const char* what);

  static std::uint32_t word(std::string_view bytes, bool swapped);

 private:
  Element small(std::uint32_t first);

  std::string_view bytes_;
  bool swapped_;
  std::size_t at_ = 0;
};

/// How many values an array of these dimensions has. @throws Fault if they make no sense
std::size_t count_of(std::string_view dimensions, bool swapped);

/// Of zlib, whole: a sum at the end is checked. @throws Fault if it is not, or above 1 GiB
std::string inflated(std::string_view bytes);

}  // namespace rvbench::hal::formats::mat5
