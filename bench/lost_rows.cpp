#include "bench/lost_rows.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/statistics.hpp"

namespace rvbench::bench {
namespace {

constexpr Eigen::Index fewest_rows = 100;
constexpr Eigen::Index rows_of_step = 100;
constexpr Eigen::Index rows_of_mean = 50;
constexpr Eigen::Index rows_of_earliest = 200;
constexpr double least_jump = 0.5;  // steps
constexpr double standing_out = 8;  // times the usual jump

double step_of(const Eigen::VectorXd& time) {
  const Eigen::Index rows = std::min(rows_of_step, time.size() / 10);
  const Eigen::VectorXd rise = time.tail(time.size() - rows) - time.head(time.size() - rows);
  return analysis::median({rise.begin(), rise.end()}) / static_cast<double>(rows);
}

// Steps by which each stamp is behind an even clock.
Eigen::VectorXd lateness(const Eigen::VectorXd& time, double step) {
  const auto last = static_cast<double>(time.size() - 1);
  return (time.array() - time[0]) / step - Eigen::ArrayXd::LinSpaced(time.size(), 0, last);
}

Eigen::Index window_at(Eigen::Index at, Eigen::Index rows) {
  return std::min({at, rows - at, rows_of_mean});
}

double jump_of_mean(const Eigen::VectorXd& late, Eigen::Index at) {
  const Eigen::Index window = window_at(at, late.size());
  return late.segment(at, window).mean() - late.segment(at - window, window).mean();
}

double jump_of_earliest(const Eigen::VectorXd& late, Eigen::Index at) {
  const Eigen::Index before = std::min(at, rows_of_earliest);
  const Eigen::Index behind = std::min(late.size() - at, rows_of_earliest);
  return late.segment(at, behind).minCoeff() - late.segment(at - before, before).minCoeff();
}

}  // namespace

std::optional<LostRows> find_lost_rows(const Eigen::VectorXd& time) {
  if (time.size() < fewest_rows || !time.allFinite()) return std::nullopt;
  const double step = step_of(time);
  if (!(step > 0)) return std::nullopt;
  const Eigen::VectorXd late = lateness(time, step);
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(late.size()));
  for (Eigen::Index at = 1; at < late.size(); ++at) {
    sizes.push_back(std::abs(jump_of_mean(late, at)));
  }
  const double usual = analysis::median(sizes);
  const Eigen::Index rows = late.size() - 1;
  const Eigen::VectorXd strides = (late.tail(rows) - late.head(rows)).cwiseAbs();
  const double stride = analysis::median({strides.begin(), strides.end()});
  LostRows lost;
  for (Eigen::Index at = 1; at < late.size(); ++at) {
    // Means over fewer rows, near an end, wander farther.
    const auto window = double(window_at(at, late.size()));
    const double wander =
        std::max(usual * std::sqrt(double(rows_of_mean) / window), stride / window);
    const double jump = jump_of_mean(late, at);
    const bool is_gap = jump >= std::max(least_jump, standing_out * wander) && jump > lost.count &&
                        jump_of_earliest(late, at) >= least_jump;
    if (is_gap) lost = {at, jump};
  }
  return lost.count > 0 ? std::optional<LostRows>(lost) : std::nullopt;
}

}  // namespace rvbench::bench
