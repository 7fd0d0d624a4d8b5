#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "hal/formats/mat_structure.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// What a MAT file says, variable by variable, until it is a recording: arrays are signals, the
/// longer side is time; a scalar of the name fs, SampleRate ... is the rate, one that ends in RPM
/// the speed, also as a field of a structure; and structures as mat_structure.hpp has them. Where
/// no array stands alone, each structure that holds arrays is a record: its longest ones are the
/// signals. Arrays whose names begin as those of different speeds do, X098 and X099, are records of
/// their own.
class MatVariables {
 public:
  /// A real array. @return why it cannot be; nothing if it was taken
  std::optional<std::string> add(const std::string& name, Eigen::MatrixXd values);
  void add(const MatStructure& structure);
  void note(std::string what) { notes_.push_back(std::move(what)); }
  /// What is no signal: "title (text)".
  void leave_out(std::string what) { left_out_.push_back(std::move(what)); }

  /// @return a recording for each record; bad_data with the notes if there is no array
  Result<std::vector<Recording>> finish(const std::filesystem::path& file) &&;

 private:
  struct NamedArray {
    std::string name;
    Eigen::MatrixXd values;
  };

  void take(const std::string& name, const std::string& shown_as, double value);
  void set(std::optional<double>& said, double unsaid, double value, const std::string& what);
  void drop_placeholders();
  void note_left_out(std::vector<std::string>& notes) const;
  std::vector<Recording> records_in_structures(const std::filesystem::path& file);
  std::vector<Recording> records_by_speed(const std::filesystem::path& file);
  Recording record(const std::string& source) &&;

  std::vector<NamedArray> arrays_;
  std::vector<MatStructure> structures_;      // that are no channel
  std::map<std::string, double> speeds_rpm_;  // by what stands before RPM
  std::vector<std::string> left_out_;
  std::vector<Channel> channels_;  // of structures
  Recording all_;
  std::optional<double> rate_Hz_, speed_rpm_;
  std::vector<std::string> notes_;
};

}  // namespace rvbench::hal::formats
