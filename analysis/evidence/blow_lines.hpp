#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/residual_envelope.hpp"

namespace rvbench::analysis {

/// Lines of the squared envelopes of one record: a weighted Σ over channels of each line's −ln p.
/// The lines of gears hold the mean of noise. A channel weighs as much as it would hear of blows
/// that are just bad, over its noise.
///
/// Shape   one line per line of the first channel's envelope; channels of another length count
///         nothing
/// Units   orders of the input shaft
class BlowLines {
 public:
  BlowLines(const std::vector<ResidualEnvelope>& channels, const Kinematics& kinematics);

  bool empty() const { return sum_.size() == 0; }
  double resolution() const { return resolution_; }
  double weight(std::size_t channel) const { return weights_[channel]; }
  double highest_order() const { return resolution_ * static_cast<double>(sum_.size()); }
  /// Without what slip and jitter spread.
  double exactly_at(double order) const { return read(sum_, order); }
  double at(double order) const { return read(highest_, order); }
  /// True if the line is `times` as high as the mean of noise.
  bool hears(double order, double times = 3) const { return at(order) > times * channels_; }
  /// Sets a line back to the mean of noise: a part explains it. spread() follows the last.
  void take(double order);
  /// Makes each line the highest of those that slip and jitter may have spread it over.
  void spread();

 private:
  double read(const Eigen::VectorXd& lines, double order) const;

  Eigen::VectorXd highest_;
  Eigen::VectorXd sum_;
  std::vector<double> weights_;  // of channels
  std::vector<bool> locked_;
  double resolution_ = 0;
  double channels_ = 0;  // Σ of their weights
};

}  // namespace rvbench::analysis
