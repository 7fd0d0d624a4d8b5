#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"
#include "hal/types/recording.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::sim {

/// The recorded inputs of a plant, made ready for its steps: the values that they have at the
/// start, in the middle and at the end of each, still in their channels' units.
///
/// It depends on which channels a plant asks for and on the steps, not on the plant's parameters:
/// made once, it serves every simulation of a fit, on any number of threads.
class Excitation {
 public:
  /// @param substeps  per sample, > 0
  /// @return the excitation, or why the channels do not fit: missing, of another unit, rate,
  ///         length or start, not finite, without a rate, fewer than 2 samples
  static std::variant<Excitation, hal::ConfigFault> make(const PlantSpec& plant,
                                                         const std::vector<Channel>& channels,
                                                         int substeps);

  Eigen::Index samples() const { return samples_; }
  double rate_Hz() const { return rate_Hz_; }
  double start_s() const { return start_s_; }
  int substeps() const { return substeps_; }
  Eigen::Index columns() const { return columns_; }

  /// The columns, in order of the plant's inputs, at one of the three stages of a step.
  /// @param step  0 .. (samples − 1)·substeps − 1  @param stage  0, 1 or 2
  const double* at(Eigen::Index step, int stage) const {
    return values_.data() + (3 * step + stage) * columns_;
  }

 private:
  void fill_between(const Eigen::VectorXd& x, Between between, Eigen::Index column);
  void fill_motion(const Eigen::VectorXd& x, const InputSpec& input, Eigen::Index column);
  void fill_curve(const Eigen::VectorXd& x, int derivative, double cutoff, double scale,
                  Eigen::Index column);
  double& value(Eigen::Index sample, int half, Eigen::Index column, bool at_end);

  Eigen::Index samples_ = 0, columns_ = 0;
  double rate_Hz_ = 0, start_s_ = 0;
  int substeps_ = 1;
  std::vector<double> values_;
};

/// Steps per sample below which a band-limited input is not followed closely enough: parabolas
/// over a step are within 0.1 % of it up to 0.6 of half the rate.
int substeps_of_inputs(const PlantSpec& plant);

}  // namespace rvbench::sim
