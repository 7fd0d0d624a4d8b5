#include "analysis/envelope/method_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double least_p = 1e-15;

Bars drawn(const MethodComparison& found, const std::vector<std::string>& candidates) {
  Bars picture{"Evidence", {"-log10 p, up to 15", 0, 16}, {}, {}};
  for (const EnvelopeMethod method : envelope_methods) {
    picture.names.emplace_back(name_of(method));
  }
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    Bars::Group group{candidates[i], {}};
    for (const MethodEvidence& each : found.evidence[i]) {
      group.values.push_back(-std::log10(std::max(each.line.p_value, least_p)));
    }
    picture.groups.push_back(std::move(group));
  }
  return picture;
}

}  // namespace

Example method_comparison_example() {
  //! [page]
  // Strikes in noise; a shaft at 20 rev/s that swings the amplitude of a mesh line.
  const Eigen::ArrayXd t_s = times_s(32000, 8000);
  const Eigen::VectorXd strikes =
      struck({.every_s = 1.0 / 83, .resonance_Hz = 2900, .decay_s = 1.5e-3}, 32000, 1);
  const Eigen::VectorXd mesh = (1 + 0.3 * wave(20 * t_s).array()) * wave(460 * t_s).array();
  const Eigen::VectorXd x = 0.5 * mesh + strikes + 0.6 * noise(32000, 2);

  const MethodComparison found =
      compare_methods(x, 8000, {{20, 0.2}, {83, 1}, {61, 1}}, {.imfs = 6});
  //! [page]
  const std::vector<std::string> candidates{"20 Hz: shaft", "83 Hz: strikes", "61 Hz: nothing"};
  Example page{"method_comparison",
               "Four methods beside each other",
               "A shaft at 20 rev/s swings the amplitude of a mesh line by 0.3; a resonance is "
               "struck 83 times a second; at 61 Hz there is nothing. Each method is asked for all "
               "three, at the same rate of false alarms, one in a thousand: what one finds and "
               "another does not is its share, and not its threshold.",
               {"envelope/method_comparison.hpp"},
               {},
               {drawn(found, candidates)}};
  const std::vector<std::string> known{"–", "–", "above 0.001"};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (const MethodEvidence& each : found.evidence[i]) {
      page.figures.push_back(
          {"p-value at " + candidates[i] + ", " + std::string(name_of(each.method)), known[i],
           p_value_text(each.line.p_value)});
    }
  }
  page.figures.push_back(
      {"share of EMD in what any method found", "–", rounded(found.share_of_emd(), 2)});
  return page;
}

}  // namespace rvbench::analysis::examples
