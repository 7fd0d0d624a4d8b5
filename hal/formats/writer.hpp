#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "hal/formats/file_draft.hpp"
#include "hal/types/recording.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal::formats {

/// What a format has a place for. What it has not is told, and never lost silently.
struct Holds {
  bool recordings = false;       ///< several in one file
  bool clocks = false;           ///< channels of unequal rate, start or length
  std::size_t channels = 65535;  ///< the most in one file
  bool names = true;             ///< of channels
  bool units = true;
  bool directions = true;
  bool any_direction = true;  ///< not +X, -RZ ... only
  bool sensitivities = true;
  bool channel_start = true;  ///< when the first sample was, on the recording's clock
  bool start_time = true;     ///< when the recording began, in UTC
  bool facts = true;          ///< speed, load, torque, repeat, status
  std::size_t status_bytes = std::string_view::npos;  ///< the most
  bool lost_samples = true;                           ///< NaN
  bool doubles = true;   ///< samples to 13 digits or more, not rounded to single precision
  bool floats = true;    ///< nor to whole steps
  bool any_rate = true;  ///< not whole Hz only
  int time_digits = 17;  ///< of the sample interval and of the first sample's time
};

/// How one format is written. A new one is a new file with a function that returns this, named in
/// the list of choose_writer.cpp.
struct Writer {
  std::string_view key;                      ///< as --format takes it: "uff58b"
  std::string_view name;                     ///< "UFF 58b"
  std::vector<std::string_view> extensions;  ///< of files that are written so unless told else
  Holds holds;
  /// Recordings that fit what it holds, each with channels, each of these with samples and a rate
  /// above 0. Leaves the draft to be finished by the caller.
  Status (*write)(const std::vector<Recording>& recordings, FileDraft& draft);
};

Writer csv_writer();
Writer flac_writer();
Writer hdf5_writer();
Writer mat5_writer();
Writer mat73_writer();
Writer tdms_writer();
Writer uff58_writer();
Writer uff58b_writer();
Writer wav_writer();

/// Whether two channels were sampled together: of one rate, start and length.
bool is_one_clock(const Channel& a, const Channel& b);

/// Whether each sample is a float: single precision holds them without rounding.
bool are_single(const Eigen::VectorXd& samples);

}  // namespace rvbench::hal::formats
