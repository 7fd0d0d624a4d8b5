#pragma once

#include <complex>

#include "tests/proof/seal/bench_campaign.hpp"
#include "tests/proof/seal/bench_effects/bench_effects.hpp"

namespace seal {

/// How large an effect is in the torque.
struct Visibility {
  double line_Nm = 0;       ///< its strongest line, or, of one in means, what calibration leaves
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
  BenchSight(const BenchNumbers& numbers, double output_turns);
  Visibility of(const HiddenInBench& effect, double size) const;

 private:
  std::vector<BenchRecord> run(const HiddenInBench* effect, double size) const;
  Visibility in_lines(const HiddenInBench& effect, const std::vector<BenchRecord>& with) const;
  Visibility in_means(const std::vector<BenchRecord>& with) const;

  BenchNumbers numbers_;
  double output_turns_;
  std::vector<BenchRecord> without_;
  std::vector<Eigen::VectorXcd> lines_;  ///< of these
};

/// Amplitudes of a record's torque at k of 121 orders of its shaft, over two turns of the output.
Eigen::VectorXcd orders_of(const BenchRecord& record, int highest);

/// Amplitude at a frequency, under a Hann window.
std::complex<double> line_of(const BenchRecord& record, double frequency_Hz);

}  // namespace seal
