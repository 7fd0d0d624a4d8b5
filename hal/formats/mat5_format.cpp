#include <fmt/format.h>
#include <matio.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/mat5_check.hpp"
#include "hal/formats/mat_variables.hpp"
#include "hal/formats/utf16.hpp"
#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::formats {
namespace {

struct CloseMat {
  void operator()(mat_t* mat) const { Mat_Close(mat); }
  void operator()(matvar_t* variable) const { Mat_VarFree(variable); }
};
using MatFile = std::unique_ptr<mat_t, CloseMat>;
using Variable = std::unique_ptr<matvar_t, CloseMat>;

template <typename Number>
Eigen::MatrixXd converted(const matvar_t& variable) {
  using Array = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;
  return Eigen::Map<const Array>(static_cast<const Number*>(variable.data),
                                 static_cast<Eigen::Index>(variable.dims[0]),
                                 static_cast<Eigen::Index>(variable.dims[1]))
      .template cast<double>();
}

// Rows x columns of a real numeric array; nothing if it is something else.
std::optional<Eigen::MatrixXd> numbers_in(const matvar_t& variable) {
  if (variable.rank != 2 || variable.isComplex || variable.isLogical || variable.data == nullptr) {
    return std::nullopt;
  }
  switch (variable.class_type) {
    case MAT_C_DOUBLE: return converted<double>(variable);
    case MAT_C_SINGLE: return converted<float>(variable);
    case MAT_C_INT64: return converted<mat_int64_t>(variable);
    case MAT_C_UINT64: return converted<mat_uint64_t>(variable);
    case MAT_C_INT32: return converted<mat_int32_t>(variable);
    case MAT_C_UINT32: return converted<mat_uint32_t>(variable);
    case MAT_C_INT16: return converted<mat_int16_t>(variable);
    case MAT_C_UINT16: return converted<mat_uint16_t>(variable);
    case MAT_C_INT8: return converted<mat_int8_t>(variable);
    case MAT_C_UINT8: return converted<mat_uint8_t>(variable);
    default: return std::nullopt;
  }
}

// Text as matio hands it over.
std::string text_of(const matvar_t& variable) {
  if (variable.class_type != MAT_C_CHAR || variable.data == nullptr) return "";
  if (variable.data_size == 2) {
    const auto* units = static_cast<const std::uint16_t*>(variable.data);
    return utf8_of({units, variable.nbytes / 2});
  }
  return {static_cast<const char*>(variable.data), variable.data_size == 1 ? variable.nbytes : 0};
}

MatStructure structure_of(const std::string& name, const matvar_t& variable) {
  MatStructure structure;
  structure.name = name;
  const unsigned fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&variable));
  char* const* names = Mat_VarGetStructFieldnames(&variable);
  if (names == nullptr) return structure;
  for (unsigned i = 0; i < fields; ++i) {
    const matvar_t* field =
        Mat_VarGetStructFieldByName(const_cast<matvar_t*>(&variable), names[i], 0);
    if (field == nullptr) continue;
    if (field->class_type == MAT_C_CHAR) structure.texts[names[i]] = text_of(*field);
    if (auto values = numbers_in(*field)) structure.numbers[names[i]] = *std::move(values);
  }
  return structure;
}

bool is_mat5(std::string_view head) { return head.starts_with("MATLAB 5.0"); }

std::optional<std::string> find_fault(const std::filesystem::path& file) {
  return find_mat5_fault(bytes_of(file));
}

std::optional<std::string> read_variables(mat_t* mat, MatVariables& variables) {
  while (const Variable variable{Mat_VarReadNextInfo(mat)}) {
    const std::string name = variable->name == nullptr ? "" : variable->name;
    if (Mat_VarReadDataAll(mat, variable.get()) != 0) return name + ": cannot be read";
    if (variable->class_type == MAT_C_STRUCT) variables.add(structure_of(name, *variable));
    if (variable->isComplex) {
      variables.note(name + " is complex, as no vibration is, and is left out");
    }
    std::optional<Eigen::MatrixXd> values = numbers_in(*variable);
    if (!values) continue;
    if (auto fault = variables.add(name, *std::move(values))) return fault;
  }
  return std::nullopt;
}

Result<std::vector<Recording>> read_mat5(const std::filesystem::path& file, const TableHints&) {
  // matio believes the sizes that it finds, and reads or allocates by them.
  if (const auto fault = find_fault(file)) return bad_file(file, *fault);
  hdf5::prepare_thread();  // matio starts HDF5 as well
  Mat_LogInitFunc("rvbench", [](int, char*) {});
  const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
  if (!mat) return bad_file(file, "not a MAT v5 file");

  MatVariables variables;
  if (const auto fault = read_variables(mat.get(), variables)) return bad_file(file, *fault);
  return std::move(variables).finish(file);
}

}  // namespace

Format mat5_format() { return {"MAT v5", is_mat5, {".mat"}, read_mat5}; }

}  // namespace rvbench::hal::formats
