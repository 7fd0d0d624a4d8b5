#include <fmt/format.h>
#include <matio.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/mat5_variables.hpp"
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

// A file in memory: matio opens files by name alone.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes) : file_(memfd_create("variable.mat", MFD_CLOEXEC)) {
    while (file_ >= 0 && !bytes.empty()) {
      const ssize_t written = write(file_, bytes.data(), bytes.size());
      if (written <= 0) throw std::bad_alloc();
      bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  ~MemoryFile() {
    if (file_ >= 0) close(file_);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  MemoryFile(MemoryFile&&) = delete;
  MemoryFile& operator=(MemoryFile&&) = delete;

  std::string path() const { return fmt::format("/proc/self/fd/{}", file_); }

 private:
  int file_;
};

const char* kind_of(const matvar_t& variable) {
  if (variable.isLogical) return "logical values";
  if (variable.class_type == MAT_C_CELL) return "cell array";
  if (variable.class_type == MAT_C_CHAR) return "text";
  if (variable.rank != 2) return "array of more than two dimensions";
  return "no real numbers";
}

// Why it cannot be taken; nothing if it was, or is told to be left out.
std::optional<std::string> take(const matvar_t& variable, MatVariables& variables) {
  const std::string name = variable.name == nullptr ? "" : variable.name;
  if (variable.class_type == MAT_C_STRUCT) {
    variables.add(structure_of(name, variable));
  } else if (variable.isComplex) {
    variables.note(name + " is complex, as no vibration is, and is left out");
  } else if (auto values = numbers_in(variable)) {
    return variables.add(name, *std::move(values));
  } else {
    variables.leave_out(fmt::format("{} ({})", name, kind_of(variable)));
  }
  return std::nullopt;
}

std::optional<std::string> read_variable(const std::string& file, MatVariables& variables) {
  const MemoryFile in_memory(file);
  const MatFile mat(Mat_Open(in_memory.path().c_str(), MAT_ACC_RDONLY));
  if (!mat) return "not a MAT v5 file";
  const Variable variable{Mat_VarReadNextInfo(mat.get())};
  if (!variable) return "a variable cannot be read";
  if (Mat_VarReadDataAll(mat.get(), variable.get()) != 0) {
    return fmt::format("{}: cannot be read", variable->name == nullptr ? "" : variable->name);
  }
  return take(*variable, variables);
}

Result<std::vector<Recording>> read_mat5(const std::filesystem::path& file, const TableHints&) {
  hdf5::prepare_thread();  // matio starts HDF5 as well
  Mat_LogInitFunc("rvbench", [](int, char*) {});
  MatVariables variables;
  const Mat5Visitor visitor{
      .take = [&](const std::string& variable) { return read_variable(variable, variables); },
      .leave_out = [&](std::string what) { variables.leave_out(std::move(what)); }};
  if (const auto fault = visit_mat5(bytes_of(file), visitor)) return bad_file(file, *fault);
  return std::move(variables).finish(file);
}

}  // namespace

Format mat5_format() { return {"MAT v5", is_mat5, {".mat"}, read_mat5}; }

}  // namespace rvbench::hal::formats
