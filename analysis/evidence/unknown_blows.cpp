#include "analysis/evidence/unknown_blows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "analysis/evidence/blow_power.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

// Jitter smears the lines of a part further than slip moves them: what lies near its order, or a
// simple ratio of it, is its own.
bool is_simple_ratio(double ratio) {
  constexpr double near = 0.03;
  for (const int over : {1, 2, 3}) {
    for (const int under : {1, 2, 3}) {
      const double simple = static_cast<double>(over) / under;
      if (std::abs(ratio - simple) < near * simple) return true;
    }
  }
  return false;
}

// A multiple of a shaft's turn, as far as a stated speed places it.
bool is_of_shaft(double spacing, const std::vector<ResidualEnvelope>& channels,
                 const Kinematics& kinematics) {
  // A channel that is left out has none.
  const double off = std::ranges::max(channels, {}, &ResidualEnvelope::order_error).order_error;
  return off > 0 && std::ranges::any_of(kinematics.signatures, [&](const Signature& part) {
           return part.shows == Shows::as_turning && is_multiple(spacing, part.order, off);
         });
}

class UnknownBlows {
 public:
  UnknownBlows(const BlowLines& lines, const std::vector<ResidualEnvelope>& channels,
               const Kinematics& kinematics)
      : lines_(lines), channels_(channels), k_(kinematics) {}

  std::vector<UnknownFamily> find() const {
    const double step = 0.5 * lines_.resolution() / blow_harmonics;
    const double highest = lines_.highest_order() / (blow_harmonics + 0.5);
    std::vector<double> roots;
    double best = 0, best_root = 0;
    for (double spacing = lowest_spacing; spacing < highest; spacing += step) {
      roots.push_back(std::cbrt(sum(spacing)));
      if (roots.back() <= best_root) continue;
      best_root = roots.back();
      best = spacing;
    }
    if (roots.size() < fewest_spacings) return {};
    const auto tries = static_cast<double>(roots.size());
    const double centre = median(roots);
    for (double& root : roots) root = std::abs(root - centre);
    const double deviation = 1.4826 * median(std::move(roots));
    best = fundamental_of(best);
    UnknownFamily family{.spacing = best, .harmonics = heard_harmonics(best)};
    family.p_value = std::min(
        1.0, tries * 0.5 * std::erfc((best_root - centre) / deviation / std::numbers::sqrt2));
    if (family.p_value > significant_p || family.harmonics == 0) return {};
    family.severity = std::sqrt(median_depth2(blow_depths(channels_, k_, best)));
    return {family};
  }

 private:
  static constexpr double lowest_spacing = 0.25;  // a cage's, 0.3 to 0.5, with room below
  // Fewer spacings show no tail as thin as a thousandth over all of them.
  static constexpr std::size_t fewest_spacings = 1000;

  double sum(double spacing) const {
    double total = 0;
    for (int h = 1; h <= blow_harmonics; ++h) total += lines_.at(h * spacing);
    return total;
  }

  // The lines of a family are those of half its spacing as well, but for every other; and twice its
  // spacing has every other of them.
  double fundamental_of(double spacing) const {
    for (const int part : {4, 3, 2}) {
      const double lower = spacing / part;
      if (lower > lowest_spacing && lines_.hears(lower) && lines_.hears(3 * lower)) return lower;
    }
    for (const int times : {2, 3}) {
      if (!lines_.hears(spacing) && lines_.hears(times * spacing)) return times * spacing;
    }
    return spacing;
  }

  int heard_harmonics(double spacing) const {
    int heard = 0;
    for (int h = 1; h <= 2 * blow_harmonics; ++h) heard += lines_.hears(h * spacing) ? 1 : 0;
    return heard;
  }

  const BlowLines& lines_;
  const std::vector<ResidualEnvelope>& channels_;
  const Kinematics& k_;
};

}  // namespace

std::vector<UnknownFamily> unknown_blows(const BlowLines& lines,
                                         const std::vector<ResidualEnvelope>& channels,
                                         const Kinematics& kinematics,
                                         const std::vector<SignatureScore>& scores) {
  std::vector<UnknownFamily> unknown = UnknownBlows(lines, channels, kinematics).find();
  std::erase_if(unknown, [&](const UnknownFamily& family) {
    return is_of_shaft(family.spacing, channels, kinematics) ||
           std::ranges::any_of(scores, [&](const SignatureScore& score) {
             const auto& part = kinematics.signatures[static_cast<std::size_t>(score.signature)];
             return part.shows == Shows::as_blows && score.p_value < significant_p &&
                    is_simple_ratio(family.spacing / score.order);
           });
  });
  return unknown;
}

}  // namespace rvbench::analysis
