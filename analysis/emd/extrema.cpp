#include "analysis/emd/extrema.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// Extrema to lay beyond each end: two of each kind, as in the source. More change little.
constexpr std::size_t beyond_end = 4;

struct Extremum {
  double at = 0;
  double value = 0;
};

Extremum reflected(Extremum e, double axis) { return {2 * axis - e.at, e.value}; }

// The mirrored extrema past one end, nearest first. nth(0) is the outermost extremum of that end.
template <class Nth>
std::vector<Extremum> past_end(Extremum end, Nth nth, std::size_t count) {
  const Extremum outermost = nth(0), next = nth(1);
  const bool end_lies_between =
      outermost.value > next.value ? end.value > next.value : end.value < next.value;

  std::vector<Extremum> out;
  if (end_lies_between) {
    for (std::size_t i = 1; i <= std::min(count - 1, beyond_end); ++i) {
      out.push_back(reflected(nth(i), outermost.at));
    }
    // One of each kind past the end: the distances from the axis tell for either end.
    const double to_end = std::abs(end.at - outermost.at);
    const bool span = std::abs(out[out.size() - 2].at - outermost.at) >= to_end;
    if (span) return out;
    out.clear();
  }
  out.push_back(end);
  for (std::size_t i = 0; i < std::min(count, beyond_end); ++i) {
    out.push_back(reflected(nth(i), end.at));
  }
  return out;
}

}  // namespace

void find_extrema(const Eigen::Ref<const Eigen::VectorXd>& h, Extrema& found) {
  const Eigen::Index last = h.size() - 1;
  if (found.at.size() < static_cast<std::size_t>(h.size())) {
    found.at.resize(static_cast<std::size_t>(h.size()));
    found.value.resize(static_cast<std::size_t>(h.size()));
  }
  found.count = 0;
  Eigen::Index i = 0;
  while (i < last && h[i + 1] == h[i]) ++i;
  if (i >= last) return;

  // No branch on the direction: that of a noisy signal cannot be predicted.
  const double* samples = h.data();
  double* at = found.at.data();
  double* value = found.value.data();
  std::size_t count = 0;
  bool was_rising = samples[i + 1] > samples[i];
  Eigen::Index plateau_from = i + 1;
  for (++i; i < last; ++i) {
    const double step = samples[i + 1] - samples[i];
    if (step == 0) continue;
    const bool is_rising = step > 0;
    at[count] = 0.5 * static_cast<double>(plateau_from + i);
    value[count] = samples[i];
    count += static_cast<std::size_t>(is_rising != was_rising);
    was_rising = is_rising;
    plateau_from = i + 1;
  }
  found.count = count;
}

void mirror_ends(const Eigen::Ref<const Eigen::VectorXd>& h, Extrema& extrema) {
  const std::size_t count = extrema.count;
  const Eigen::Index last = h.size() - 1;
  const auto from_left = [&](std::size_t i) { return Extremum{extrema.at[i], extrema.value[i]}; };
  const auto from_right = [&](std::size_t i) { return from_left(count - 1 - i); };
  const auto before = past_end({0, h[0]}, from_left, count);
  const auto after = past_end({static_cast<double>(last), h[last]}, from_right, count);

  const std::size_t total = before.size() + count + after.size();
  const auto lay = [&](std::vector<double>& all, double Extremum::*part) {
    if (all.size() < total) all.resize(total);
    const auto begin = all.begin();
    const auto shift = static_cast<std::ptrdiff_t>(before.size());
    const auto kept = static_cast<std::ptrdiff_t>(count);
    std::copy_backward(begin, begin + kept, begin + shift + kept);
    std::transform(before.rbegin(), before.rend(), begin,
                   [&](const Extremum& e) { return e.*part; });
    std::transform(after.begin(), after.end(), begin + shift + kept,
                   [&](const Extremum& e) { return e.*part; });
  };
  lay(extrema.at, &Extremum::at);
  lay(extrema.value, &Extremum::value);
  extrema.count = total;
}

}  // namespace rvbench::analysis
