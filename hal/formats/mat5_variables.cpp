#include "hal/formats/mat5_variables.hpp"

#include <fmt/format.h>

#include "hal/formats/mat5_elements.hpp"
#include "hal/formats/mat5_rewriting.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::size_t header_bytes = 128;

// Whether the variable is of a kind that is read. @param out  as of mat5::write_variable()
bool take_variable(const mat5::Element& element, bool swapped, const Mat5Visitor& visitor,
                   std::string* out) {
  if (element.type == mat5::matrix)
    return mat5::write_variable(element.data, swapped, visitor.leave_out, out);
  if (element.type != mat5::compressed) throw mat5::Fault("no variable where one should begin");
  const std::string bytes = mat5::inflated(element.data);
  mat5::Elements inner(bytes, swapped);
  const bool is_read = mat5::write_variable(inner.expect(mat5::matrix, "variable").data, swapped,
                                            visitor.leave_out, out);
  if (!inner.at_end()) throw mat5::Fault("has more bytes than its size says");
  return is_read;
}

// The first fault in the structure.
std::optional<std::string> find_fault(std::string_view file, bool swapped) {
  mat5::Elements variables(file.substr(header_bytes), swapped);
  const Mat5Visitor nobody;
  while (!variables.at_end()) {
    const std::size_t at = variables.at() + header_bytes;
    try {
      take_variable(variables.next(), swapped, nobody, nullptr);
    } catch (const mat5::Fault& fault) {
      return fmt::format("variable at byte {}: {}", at, fault.what());
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> visit_mat5(std::string_view file, const Mat5Visitor& visitor) {
  if (file.size() < header_bytes) return "shorter than the header of a MAT v5 file";
  const std::string_view order = file.substr(126, 2);
  if (order != "IM" && order != "MI") return "not a MAT v5 file";
  const bool swapped = order == "MI";  // written by a big-endian machine
  const std::string_view version_1 =
      swapped ? std::string_view("\x01\0", 2) : std::string_view("\0\x01", 2);
  if (file.substr(124, 2) != version_1) return "not a MAT v5 file (save it with -v7 or -v6)";
  // Before anything is taken: of a damaged file nothing is.
  if (auto fault = find_fault(file, swapped)) return fault;
  mat5::Elements variables(file.substr(header_bytes), swapped);
  while (!variables.at_end()) {
    std::string of_one(file.substr(0, header_bytes));
    if (!take_variable(variables.next(), swapped, visitor, &of_one)) continue;
    if (auto fault = visitor.take(of_one)) return fault;
  }
  return std::nullopt;
}

}  // namespace rvbench::hal::formats
