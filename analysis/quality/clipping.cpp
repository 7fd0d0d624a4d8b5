#include "analysis/quality/clipping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "analysis/smallest_step.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index shortest_run = 3;
constexpr double rail_rounding = 1e-9;  // of the largest magnitude
constexpr double few = 0.1;             // pass a rail, of those that it holds
constexpr double least_jump = 0.03;     // of the rms change from sample to sample
constexpr double at_rest = 0.75;        // of all samples
constexpr double least_moving = 0.01;   // of all samples, in no run
constexpr Eigen::Index fewest_repeats = 10;
constexpr double far_oftener = 10;           // than any of the next values
constexpr std::size_t next_values = 5;       // further in
constexpr std::ptrdiff_t few_enough = 1000;  // samples

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

struct Value {
  double value;
  Eigen::Index count;
};

// The values that so many samples have, from the largest on.
std::vector<Value> values_of_largest(std::vector<double>& x, std::ptrdiff_t most, double equal) {
  const auto end = x.begin() + most;
  if (end != x.end()) std::ranges::nth_element(x, end, std::ranges::greater{});
  std::sort(x.begin(), end, std::ranges::greater{});
  std::vector<Value> values;
  for (auto one = x.begin(); one != end; ++one) {
    if (values.empty() || values.back().value - *one > equal) values.push_back({*one, 0});
    ++values.back().count;
  }
  return values;
}

// The outermost values that samples have, from the largest on: as few as can show a rail, for to
// sort all takes long.
std::vector<Value> values_from_top(const Eigen::VectorXd& x, double equal) {
  std::vector<double> all(x.begin(), x.end());
  const std::ptrdiff_t n = std::ssize(all);
  for (std::ptrdiff_t most = std::min(n, std::max(few_enough, n / 50));;
       most = std::min(n, 4 * most)) {
    std::vector<Value> values = values_of_largest(all, most, equal);
    const bool may_be_held = 4 * values.back().count > most || values.size() < next_values + 2;
    if (most == n) return values;
    if (may_be_held) continue;
    values.pop_back();  // it may go on
    return values;
  }
}

// Whether what is beside the samples at a rail is off by more than a crest would be.
bool is_left_by_jumps(const Eigen::VectorXd& x, double rail, double equal, double crest) {
  double jumps = 0, neighbours = 0;
  const auto leave_by = [&](double beside) {
    if (beside >= rail - equal) return;
    jumps += rail - beside;
    ++neighbours;
  };
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    if (std::abs(x[i] - rail) <= equal) leave_by(x[i - 1]);
    if (std::abs(x[i - 1] - rail) <= equal) leave_by(x[i]);
  }
  return jumps > crest * neighbours;
}

// Samples at the outermost value that comes back far oftener than those beside it, whether in a row
// or one at a time.
Eigen::Index repeated_at_top(const Eigen::VectorXd& x, double equal, double crest) {
  const std::vector<Value> values = values_from_top(x, equal);
  const double most_held = at_rest * double(x.size());
  Eigen::Index beyond = 0;
  for (std::size_t i = 0; i + 1 < values.size() && double(beyond) <= few * most_held; ++i) {
    const Eigen::Index held = values[i].count;
    const auto inside = values.begin() + std::ptrdiff_t(i) + 1;
    const auto end = values.begin() + std::ptrdiff_t(std::min(i + 1 + next_values, values.size()));
    const Eigen::Index beside = std::ranges::max_element(inside, end, {}, &Value::count)->count;
    const bool is_rail = held >= fewest_repeats && double(beyond) <= few * double(held) &&
                         double(held) >= far_oftener * double(beside) && double(held) < most_held;
    if (is_rail) return is_left_by_jumps(x, values[i].value, equal, crest) ? held : 0;
    beyond += held;
  }
  return 0;
}

Eigen::Index clipped_at_top(const Eigen::VectorXd& x, double equal, double crest) {
  return std::max(held_at_top(x, equal, crest), repeated_at_top(x, equal, crest));
}

}  // namespace

Eigen::Index clipped_samples(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < shortest_run) return 0;
  const double equal = rail_rounding * x.cwiseAbs().maxCoeff();
  Eigen::Index in_runs = 0;
  for (const Run& run : runs_of(x, equal)) in_runs += run.size;
  if (double(x.size() - in_runs) < least_moving * double(x.size())) return 0;
  const Eigen::Index changes = x.size() - 1;
  const double rms_change = (x.tail(changes) - x.head(changes)).norm() / std::sqrt(double(changes));
  const double crest = std::max(steps_of_crest * smallest_step(x), least_jump * rms_change);
  return std::max(clipped_at_top(x, equal, crest) + clipped_at_top(-x, equal, crest),
                  held_at_top(x.cwiseAbs(), equal, crest));
}

}  // namespace rvbench::analysis
