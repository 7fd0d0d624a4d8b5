#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "bench/compare_sections.hpp"
#include "bench/compare_text.hpp"
#include "bench/report/html.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

using analysis::Change;
using analysis::ChangeWord;
using analysis::Comparison;

constexpr std::size_t most_pairs = 6;
constexpr double fewest_orders = 3;  // shown
constexpr double beyond = 1.2;       // of the highest line that is to be seen

// One channel of one point, worth a look.
struct Look {
  std::size_t point = 0, channel = 0;
  double highest_order = 0;  // of what changed; else of all lines that are seen
  std::vector<const Change*> changed;
  double most_dB = 0;
};

std::vector<Look> looks_of(const Comparison& comparison) {
  std::map<std::pair<std::size_t, std::size_t>, Look> all;
  for (const Change& change : comparison.changes) {
    const analysis::Quantity& quantity = comparison.quantities[change.quantity];
    if (!quantity.is_line() || !change.is_seen()) continue;
    Look& look = all[{change.point, change.channel}];
    look.point = change.point;
    look.channel = change.channel;
    if (change.word == ChangeWord::changed) {
      look.changed.push_back(&change);
      look.most_dB = std::max(look.most_dB, std::abs(change.change_dB));
    }
  }
  for (const Change& change : comparison.changes) {
    const auto look = all.find({change.point, change.channel});
    if (look == all.end() || !change.is_seen()) continue;
    if (!look->second.changed.empty() && change.word != ChangeWord::changed) continue;
    const double order = comparison.quantities[change.quantity].order;
    look->second.highest_order = std::fmax(look->second.highest_order, order);
  }
  std::vector<Look> looks;
  for (auto& [place, look] : all) looks.push_back(std::move(look));
  return looks;
}

// Of each point the channel with the largest change; of points those with the largest.
std::vector<Look> chosen(std::vector<Look> looks) {
  std::ranges::stable_sort(looks, std::greater<>(), &Look::most_dB);
  std::vector<Look> first;
  for (Look& look : looks) {
    const bool known =
        std::ranges::any_of(first, [&](const Look& l) { return l.point == look.point; });
    const bool quiet = look.changed.empty() && !first.empty();
    if (!known && !quiet && first.size() < most_pairs) first.push_back(std::move(look));
  }
  std::ranges::sort(first, {}, &Look::point);
  return first;
}

std::string figure(const char* side, const analysis::Spectrum& spectrum, const Look& look,
                   const Comparison& comparison, const PlotAxis& x, const PlotAxis& y) {
  const auto lines = std::min<Eigen::Index>(
      spectrum.amplitude.size(), static_cast<Eigen::Index>(x.max / spectrum.resolution) + 1);
  SvgPlot plot(fmt::format("{}: {}", side, comparison.channels[look.channel].name), x, y);
  plot.add_trace(0, spectrum.resolution, spectrum.amplitude.head(lines),
                 side[0] == 'A' ? "before" : "after");
  for (const Change* change : look.changed) {
    const double order = comparison.quantities[change->quantity].order;
    plot.add_mark(order, fmt::format("{:.4g}: {}", order, change_text(change->change_dB)));
  }
  return "<figure style=\"margin:0\">" + plot.svg() + "</figure>\n";
}

std::string pair_of_figures(const Look& look, const SpectrumPair& pair,
                            const Comparison& comparison) {
  const std::string& unit = comparison.channels[look.channel].unit;
  const double last = std::max(fewest_orders, beyond * look.highest_order);
  const PlotAxis x{"order of the input shaft", 0, last};
  double most = 0;
  for (const analysis::Spectrum* spectrum : {&pair.a, &pair.b}) {
    const auto lines = std::min<Eigen::Index>(
        spectrum->amplitude.size(), static_cast<Eigen::Index>(last / spectrum->resolution) + 1);
    most = std::max(most, spectrum->amplitude.head(lines).maxCoeff());
  }
  const PlotAxis y = axis_around(unit.empty() ? "signal" : "acceleration [" + unit + "]",
                                 Eigen::Vector2d(0, most));
  return "<div class=\"figures\">\n" + figure("A, before", pair.a, look, comparison, x, y) +
         figure("B, after", pair.b, look, comparison, x, y) + "</div>\n";
}

std::string heading_of(const Look& look, const Comparison& comparison) {
  Change at;
  at.point = look.point;
  at.channel = look.channel;
  return "<h3>" + xml_escaped(place_text(at, comparison)) + "</h3>\n";
}

}  // namespace

std::string compare_spectra_section(const Comparison& comparison, const CompareFacts& facts,
                                    const SpectrumLoader& spectra) {
  std::string body;
  for (const Look& look : chosen(looks_of(comparison))) {
    const auto pair = spectra(look.point, comparison.channels[look.channel].name);
    if (!pair) continue;
    body += heading_of(look, comparison) + pair_of_figures(look, *pair, comparison);
  }
  if (body.empty()) return "";
  return section(
      "Spectra before and after",
      paragraph("Amplitude over orders of the input shaft of " + facts.kinematics.machine +
                ", averaged in power over the repeats. Of each point the channel in "
                "which most changed; marks are lines that did.") +
          body);
}

}  // namespace rvbench::bench::report
