#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <system_error>

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/mat_variables.hpp"
#include "hal/formats/utf16.hpp"
#include "hal/hdf5/attributes.hpp"
#include "hal/hdf5/plain_array.hpp"
#include "hal/hdf5/stored_data.hpp"

namespace rvbench::hal::formats {
namespace {

using namespace hdf5;

constexpr std::size_t longest_text = 65536;

bool is_mat73(std::string_view head) { return head.starts_with("MATLAB 7.3"); }

bool is_number_class(const std::string& kind) {
  static constexpr std::array<std::string_view, 10> kinds = {
      "double", "single", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"};
  return std::ranges::find(kinds, kind) != kinds.end();
}

// What a dataset or group is; empty if it does not say.
std::string class_of(const Handle& object) {
  return read_text(object, "MATLAB_class").value_or("");
}

bool is_empty(const Handle& dataset) {
  return read_number(dataset, "MATLAB_empty").value_or(0) != 0;
}

bool is_complex(const Handle& dataset, const std::string& place) {
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, place);
  return H5Tget_class(type.id()) == H5T_COMPOUND;
}

class Reading {
 public:
  Reading(const Handle& file, std::size_t file_bytes) : file_(file), file_bytes_(file_bytes) {}

  // The fault of a variable, or none: then it was taken, or is of a kind that is passed over.
  std::optional<std::string> take(const std::string& name, MatVariables& variables) const {
    if (name.starts_with('#')) return std::nullopt;  // #refs#, #subsystem#: MATLAB's own
    const Handle object = open(name);
    const std::string kind = class_of(object);
    if (H5Iget_type(object.id()) == H5I_GROUP) {
      if (kind == "struct") {
        variables.add(structure_of(name));
      } else {
        leave_out(name, kind, variables);
      }
      return std::nullopt;
    }
    if (is_empty(object)) return std::nullopt;
    if (!is_number_class(kind)) {
      leave_out(name, kind, variables);
      return std::nullopt;
    }
    if (is_complex(object, name)) {
      variables.note(name + " is complex, as no vibration is, and is left out");
      return std::nullopt;
    }
    return variables.add(name, numbers_in(object, name));
  }

 private:
  static void leave_out(const std::string& name, const std::string& kind, MatVariables& variables) {
    variables.leave_out(fmt::format("{} ({})", name, kind.empty() ? "no variable" : kind));
  }

  Handle open(const std::string& name) const {
    return own(H5Oopen(file_.id(), name.c_str(), H5P_DEFAULT), H5Oclose, name);
  }

  // HDF5's columns are MATLAB's rows.
  Eigen::MatrixXd numbers_in(const Handle& dataset, const std::string& place) const {
    return read_array(dataset, file_bytes_, place).transpose();
  }

  std::string text_in(const Handle& dataset, const std::string& place) const {
    const Extent extent = checked_extent(dataset, file_bytes_, place);
    if (extent.rows > longest_text || extent.columns > longest_text / (extent.rows + 1)) {
      throw FileFailure(IoErrc::bad_data, place + ": text too long");
    }
    std::vector<std::uint16_t> units(extent.rows * extent.columns);
    if (units.empty()) return "";
    check(H5Dread(dataset.id(), H5T_NATIVE_UINT16, H5S_ALL, H5S_ALL, H5P_DEFAULT, units.data()),
          place);
    return utf8_of(units);
  }

  MatStructure structure_of(const std::string& name) const {
    MatStructure structure;
    structure.name = name;
    for (const std::string& field : names_in(file_, name)) {
      const std::string place = name + "/" + field;
      const Handle object = open(place);
      if (H5Iget_type(object.id()) != H5I_DATASET) continue;
      const std::string kind = class_of(object);
      if (is_empty(object) || is_complex(object, place)) continue;
      if (kind == "char") structure.texts[field] = text_in(object, place);
      if (is_number_class(kind)) structure.numbers[field] = numbers_in(object, place);
    }
    return structure;
  }

  const Handle& file_;
  std::size_t file_bytes_;
};

Result<std::vector<Recording>> read_mat73(const std::filesystem::path& file, const TableHints&) {
  return guarded(file, [&]() -> Result<std::vector<Recording>> {
    std::error_code error;
    const auto bytes = std::filesystem::file_size(file, error);
    if (error) return bad_file(file, error.message());
    const Handle access = file_access();
    const Handle opened = own(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, "open");
    const Reading reading(opened, bytes);
    MatVariables variables;
    for (const std::string& name : names_in(opened, "/")) {
      if (auto fault = reading.take(name, variables)) return bad_file(file, *fault);
    }
    return std::move(variables).finish(file);
  });
}

}  // namespace

Format mat73_format() { return {"MAT v7.3", is_mat73, {}, read_mat73}; }

}  // namespace rvbench::hal::formats
