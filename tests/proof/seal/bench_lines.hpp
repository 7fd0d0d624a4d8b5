#pragma once

#include <complex>

#include "tests/proof/seal/bench_campaign.hpp"
#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {

/// How large an effect is in the torque.
struct Visibility {
  /// Its strongest line; of an effect that changes means or lines that the machine has anyway, what
  /// a calibration within all tolerances leaves of that.
  double line_Nm = 0;
  double strongest_Nm = 0;  ///< the strongest line of the meshes without it
  /// Its strongest line under each corner of the matrix.
  struct Line {
    double amplitude_Nm = 0;
    double frequency_Hz = 1;
    double length_s = 0;  ///< of a record there
  };
  std::vector<Line> under;
};

/// Looks at a machine with and without an effect, free of noise, once under each corner.
/// @throws std::runtime_error if the machine does not come to turn steadily with it
class BenchSight {
 public:
  /// @param machine  as built: a plant file
  BenchSight(nlohmann::json machine, double output_turns);
  Visibility of(const HiddenInBench& effect, double size);

 private:
  Visibility in_lines(const HiddenInBench& effect, const std::vector<BenchRecord>& with) const;
  Visibility in_means(const std::vector<BenchRecord>& with) const;
  Visibility in_own_lines(const std::vector<BenchRecord>& with);

  nlohmann::json machine_;
  BenchNumbers numbers_;
  double output_turns_;
  std::vector<BenchRecord> without_;
  std::vector<Eigen::VectorXcd> lines_;  ///< of these
  Eigen::MatrixXd moved_Nm_;  ///< own lines x numbers: by a standard deviation; empty: not looked
};

/// Amplitudes of a record's torque at k of 121 orders of its shaft, over two turns of the output.
Eigen::VectorXcd orders_of(const BenchRecord& record, int highest);

/// Amplitude at a frequency, under a Hann window.
std::complex<double> line_of(const BenchRecord& record, double frequency_Hz);

}  // namespace seal
