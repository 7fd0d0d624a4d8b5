#include "analysis/quality/clipping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/smallest_step.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index shortest_run = 3;
constexpr double rounding = 1e-9;      // of the largest magnitude
constexpr double few = 0.1;            // pass a rail, of those that it holds
constexpr double steps_of_crest = 5;   // from a crest of equal samples to its neighbours
constexpr double least_jump = 0.03;    // of the rms change from sample to sample
constexpr double at_rest = 0.75;       // of all samples
constexpr double least_moving = 0.01;  // of all samples, in no run

struct Run {
  Eigen::Index first, size;
};

std::vector<Run> runs_of(const Eigen::VectorXd& x, double equal) {
  std::vector<Run> runs;
  Eigen::Index first = 0;
  for (Eigen::Index i = 1; i <= x.size(); ++i) {
    if (i < x.size() && std::abs(x[i] - x[first]) <= equal) continue;
    if (i - first >= shortest_run) runs.push_back({first, i - first});
    first = i;
  }
  return runs;
}

// Samples that the upper rail holds, if there is one.
Eigen::Index held_at_top(const Eigen::VectorXd& x, double equal, double crest) {
  const std::vector<Run> runs = runs_of(x, equal);
  double rail = -std::numeric_limits<double>::infinity();
  for (const Run& run : runs) rail = std::max(rail, x[run.first]);
  Eigen::Index held = 0, neighbours = 0;
  double jumps = 0;
  const auto leave_by = [&](Eigen::Index i) {
    if (i < 0 || i >= x.size() || x[i] > rail) return;
    jumps += rail - x[i];
    ++neighbours;
  };
  for (const Run& run : runs) {
    if (x[run.first] < rail - equal) continue;
    held += run.size;
    leave_by(run.first - 1);
    leave_by(run.first + run.size);
  }
  const Eigen::Index beyond = (x.array() > rail + equal).count();
  const bool is_rail = double(beyond) <= few * double(held) && jumps > crest * double(neighbours) &&
                       double(held) < at_rest * double(x.size());
  return is_rail ? held : 0;
}

}  // namespace

Eigen::Index clipped_samples(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < shortest_run) return 0;
  const double equal = rounding * x.cwiseAbs().maxCoeff();
  Eigen::Index in_runs = 0;
  for (const Run& run : runs_of(x, equal)) in_runs += run.size;
  if (double(x.size() - in_runs) < least_moving * double(x.size())) return 0;
  const Eigen::Index changes = x.size() - 1;
  const double rms_change = (x.tail(changes) - x.head(changes)).norm() / std::sqrt(double(changes));
  const double crest = std::max(steps_of_crest * smallest_step(x), least_jump * rms_change);
  return std::max(held_at_top(x, equal, crest) + held_at_top(-x, equal, crest),
                  held_at_top(x.cwiseAbs(), equal, crest));
}

}  // namespace rvbench::analysis
