#include "analysis/order/synchronous_average.hpp"

#include <cmath>

#include "analysis/fft.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

// One column per period.
Eigen::Map<const Eigen::MatrixXd> folded(const char* whose,
                                         const Eigen::Ref<const Eigen::VectorXd>& x,
                                         Eigen::Index samples_per_period) {
  const Require require{whose};
  require(samples_per_period >= 2, "samples_per_period must be at least 2");
  require(x.size() > 0 && x.size() % samples_per_period == 0, "x must be whole periods");
  require(x.allFinite(), "a sample is not finite");
  return {x.data(), samples_per_period, x.size() / samples_per_period};
}

}  // namespace

double SynchronousAverage::p_value(Eigen::Index line) const {
  Require{"SynchronousAverage::p_value"}(line >= 0 && line < lines.size(), "no such line");
  const double noise = 2 * line_error[line] * line_error[line], power = std::norm(lines[line]);
  if (!(noise > 0)) return power > 0 ? 0 : 1;
  // Lines 0 and N/2 are real: one degree of freedom each, Student's t.
  const bool is_real = line == 0 || (average.size() % 2 == 0 && line == lines.size() - 1);
  const auto freedom = static_cast<double>(periods - 1);
  return is_real ? t_p_value(std::sqrt(2 * power / noise), freedom)
                 : line_p_value(power / noise, 1, freedom);
}

SynchronousAverage synchronous_average(const Eigen::Ref<const Eigen::VectorXd>& x,
                                       Eigen::Index samples_per_period) {
  const auto periods = folded("synchronous_average", x, samples_per_period);
  Require{"synchronous_average"}(periods.cols() >= 2, "at least two periods are needed");
  const auto count = static_cast<double>(periods.cols());
  SynchronousAverage mean;
  mean.periods = periods.cols();
  mean.average = periods.rowwise().mean();
  mean.standard_error =
      ((periods.colwise() - mean.average).rowwise().squaredNorm() / (count * (count - 1)))
          .cwiseSqrt();

  mean.lines = fft(mean.average);
  Eigen::VectorXd scatter = Eigen::VectorXd::Zero(mean.lines.size());
  for (Eigen::Index p = 0; p < periods.cols(); ++p) {
    scatter += fft(periods.col(p) - mean.average).cwiseAbs2();
  }
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(mean.lines.size(), 2);
  Eigen::VectorXd parts = Eigen::VectorXd::Constant(mean.lines.size(), 2);  // real and imaginary
  scale[0] = parts[0] = 1;
  if (samples_per_period % 2 == 0) scale.tail<1>()[0] = parts.tail<1>()[0] = 1;
  scale /= static_cast<double>(samples_per_period);
  mean.lines.array() *= scale.array();
  mean.line_error =
      scale.array() * (scatter.array() / (parts.array() * count * (count - 1))).sqrt();
  return mean;
}

Eigen::VectorXd without_average(const Eigen::Ref<const Eigen::VectorXd>& x,
                                Eigen::Index samples_per_period) {
  const auto periods = folded("without_average", x, samples_per_period);
  const Eigen::VectorXd average = periods.rowwise().mean();
  return x - average.replicate(periods.cols(), 1);
}

}  // namespace rvbench::analysis
