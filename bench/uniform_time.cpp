#include "bench/uniform_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/statistics.hpp"

namespace rvbench::bench {
namespace {

constexpr double as_good_as_uniform = 0.01;  // of a step
constexpr double longest_gap = 10;           // steps

}  // namespace

std::variant<UniformTime, std::string> uniform_time(const Eigen::VectorXd& time_s, double rate_Hz) {
  const Eigen::Index n = time_s.size();
  if (n < 2) return "fewer than 2 time stamps";
  const Eigen::VectorXd steps = time_s.tail(n - 1) - time_s.head(n - 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    if (!(steps[i] > 0)) {
      return fmt::format("time does not rise from row {} ({} s) to the next ({} s)", i + 1,
                         time_s[i], time_s[i + 1]);
    }
  }
  UniformTime time;
  const double step_s = analysis::median(std::vector<double>(steps.begin(), steps.end()));
  time.rate_Hz = std::isnan(rate_Hz) ? 1 / step_s : rate_Hz;
  time.start_s = time_s[0];
  time.worst_gap_s = steps.maxCoeff();
  if (time.worst_gap_s > longest_gap * step_s) {
    Eigen::Index at = 0;
    steps.maxCoeff(&at);
    return fmt::format("a gap of {:.3g} s after {:.6g} s, where samples are {:.3g} s apart",
                       time.worst_gap_s, time_s[at], step_s);
  }
  time.samples = static_cast<Eigen::Index>((time_s[n - 1] - time_s[0]) * time.rate_Hz + 1e-6) + 1;
  double worst = 0;
  for (Eigen::Index i = 0; i < std::min(n, time.samples); ++i) {
    const double due_s = time.start_s + static_cast<double>(i) / time.rate_Hz;
    worst = std::max(worst, std::abs(time_s[i] - due_s));
  }
  time.resampled = time.samples != n || worst > as_good_as_uniform / time.rate_Hz;
  return time;
}

Eigen::VectorXd resampled(const Eigen::VectorXd& time_s, const Eigen::VectorXd& values,
                          const UniformTime& time) {
  Eigen::VectorXd out(time.samples);
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < time.samples; ++i) {
    const double t_s = time.start_s + static_cast<double>(i) / time.rate_Hz;
    while (at + 2 < time_s.size() && time_s[at + 1] < t_s) ++at;
    const double share = (t_s - time_s[at]) / (time_s[at + 1] - time_s[at]);
    out[i] = values[at] + std::clamp(share, 0.0, 1.0) * (values[at + 1] - values[at]);
  }
  return out;
}

}  // namespace rvbench::bench
