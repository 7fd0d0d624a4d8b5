#include <fmt/format.h>
#include <matio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include "hal/formats/foreign_file.hpp"
#include "hal/formats/format.hpp"
#include "hal/formats/mat5_check.hpp"
#include "hal/hdf5/hdf5_handle.hpp"

namespace rvbench::hal::formats {
namespace {

constexpr std::size_t most_channels = 256;  // of one array: more is no set of signals

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

bool says_rate(std::string_view name) {
  static constexpr std::array<std::string_view, 8> names = {
      "fs", "Fs", "FS", "SampFreq", "SampleRate", "sample_rate", "sampling_rate", "rate_Hz"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

// What the file says besides samples. What it says twice, and differently, it does not say.
struct Statements {
  std::optional<double> rate_Hz;
  std::optional<double> speed_rpm;
  std::vector<std::string> notes;

  void take(const std::string& name, const std::string& shown_as, double value) {
    const bool is_rate = says_rate(name);
    const bool is_speed = name.ends_with("RPM") || name.ends_with("rpm");
    if (!(value > 0) || !std::isfinite(value)) {
      if (!is_rate && !is_speed) return;
      notes.push_back(fmt::format("{}: {} is no {} and is not taken", shown_as, value,
                                  is_rate ? "rate" : "speed of a shaft that turns forward"));
      return;
    }
    if (is_rate) set(rate_Hz, 0, value, "rate_Hz from " + shown_as);
    if (is_speed) {
      set(speed_rpm, not_known, value, "speed_rpm from " + shown_as);
    }
  }

 private:
  void set(std::optional<double>& said, double unsaid, double value, const std::string& what) {
    if (said == value) return;
    notes.push_back(
        said ? fmt::format("{}: {}, but {} elsewhere: neither is taken", what, value, *said)
             : fmt::format("{}: {}", what, value));
    said = said ? unsaid : value;
  }
};

void take_fields(const std::string& name, const matvar_t& structure, Statements& statements) {
  const unsigned fields = Mat_VarGetNumberOfFields(const_cast<matvar_t*>(&structure));
  char* const* names = Mat_VarGetStructFieldnames(&structure);
  if (names == nullptr) return;
  for (unsigned i = 0; i < fields; ++i) {
    const matvar_t* field =
        Mat_VarGetStructFieldByName(const_cast<matvar_t*>(&structure), names[i], 0);
    if (field == nullptr) continue;
    const std::optional<Eigen::MatrixXd> value = numbers_in(*field);
    if (value && value->size() == 1) {
      statements.take(names[i], name + "." + names[i], (*value)(0, 0));
    }
  }
}

struct NamedArray {
  std::string name;
  Eigen::MatrixXd values;
};

// Of arrays of one name, those of zeros only are left out if another one is not: some loggers
// write a variable once to reserve room, and again with what they measured.
void drop_placeholders(std::vector<NamedArray>& arrays, std::vector<std::string>& notes) {
  const auto is_placeholder = [&arrays](const NamedArray& array) {
    return array.values.isZero(0) &&
           std::any_of(arrays.begin(), arrays.end(), [&array](const NamedArray& other) {
             return other.name == array.name && !other.values.isZero(0);
           });
  };
  std::vector<NamedArray> kept;
  for (const NamedArray& array : arrays) {
    if (is_placeholder(array)) {
      notes.push_back(
          fmt::format("{} is there more than once: one of zeros only is left out", array.name));
    } else {
      kept.push_back(array);
    }
  }
  arrays = std::move(kept);
}

// The longer side of an array is time. Repeated names get a number.
void add_channels(const NamedArray& array, std::vector<Channel>& channels) {
  const bool upright = array.values.rows() >= array.values.cols();
  const Eigen::Index count = upright ? array.values.cols() : array.values.rows();
  for (Eigen::Index i = 0; i < count; ++i) {
    Channel channel;
    const std::string base = count == 1 ? array.name : fmt::format("{}_{}", array.name, i + 1);
    channel.info.name = base;
    const auto taken = [&channel](const Channel& c) { return c.info.name == channel.info.name; };
    for (int n = 2; std::any_of(channels.begin(), channels.end(), taken); ++n) {
      channel.info.name = fmt::format("{}_{}", base, n);
    }
    if (upright) {
      channel.samples = array.values.col(i);
    } else {
      channel.samples = array.values.row(i).transpose();
    }
    channels.push_back(std::move(channel));
  }
}

bool recognises(std::string_view head) { return head.starts_with("MATLAB 5.0"); }

std::optional<std::string> find_fault(const std::filesystem::path& file) {
  return find_mat5_fault(bytes_of(file));
}

std::optional<std::string> read_variables(mat_t* mat, std::vector<NamedArray>& arrays,
                                          Statements& statements) {
  while (const Variable variable{Mat_VarReadNextInfo(mat)}) {
    const std::string name = variable->name == nullptr ? "" : variable->name;
    if (Mat_VarReadDataAll(mat, variable.get()) != 0) return name + ": cannot be read";
    if (variable->class_type == MAT_C_STRUCT) take_fields(name, *variable, statements);
    if (variable->isComplex) {
      statements.notes.push_back(name + " is complex, as no vibration is, and is left out");
    }
    std::optional<Eigen::MatrixXd> values = numbers_in(*variable);
    if (!values || values->size() == 0) continue;
    if (values->size() == 1) {
      statements.take(name, name, (*values)(0, 0));
    } else if (static_cast<std::size_t>(std::min(values->rows(), values->cols())) > most_channels) {
      return fmt::format("{}: {} x {} is no set of signals", name, values->rows(), values->cols());
    } else {
      arrays.push_back({name, std::move(*values)});
    }
  }
  return std::nullopt;
}

Result<std::vector<Recording>> read(const std::filesystem::path& file) {
  // matio believes the sizes that it finds, and reads or allocates by them.
  if (const auto fault = find_fault(file)) return bad_file(file, *fault);
  hdf5::prepare_thread();  // matio starts HDF5 as well
  Mat_LogInitFunc("rvbench", [](int, char*) {});
  const MatFile mat(Mat_Open(file.c_str(), MAT_ACC_RDONLY));
  if (!mat) return bad_file(file, "not a MAT v5 file");

  std::vector<NamedArray> arrays;
  Statements statements;
  if (const auto fault = read_variables(mat.get(), arrays, statements)) {
    return bad_file(file, *fault);
  }
  if (arrays.empty() && !statements.notes.empty()) {
    return bad_file(file, fmt::format("holds no samples; {}", fmt::join(statements.notes, "; ")));
  }
  Recording recording;
  recording.source = file.string();
  recording.status = "ok";
  recording.speed_rpm = statements.speed_rpm.value_or(not_known);
  recording.notes = std::move(statements.notes);
  drop_placeholders(arrays, recording.notes);
  for (const NamedArray& array : arrays) add_channels(array, recording.channels);
  for (Channel& channel : recording.channels) channel.rate_Hz = statements.rate_Hz.value_or(0);
  return std::vector<Recording>{std::move(recording)};
}

}  // namespace

Format mat5_format() { return {"MAT v5", recognises, {".mat"}, read}; }

}  // namespace rvbench::hal::formats
