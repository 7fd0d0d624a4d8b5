#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

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
constexpr std::size_t most_marks = 5;
constexpr double fewest_orders = 3;  // shown
constexpr double beyond = 1.2;       // of the highest line that is to be seen

// One channel of one point, worth a look.
struct Look {
  std::size_t point = 0, channel = 0;
  std::vector<const Change*> changed;  // what is to be seen of it: the most first
  double most = 0;                     // of it, in the unit of the channel
  double highest_order = 0;            // of what changed; of all lines that are seen if none did
};

// How much of a change a plot of amplitudes shows.
double to_be_seen(const Change* change) {
  return std::abs(ratio_from_dB(change->b_dB) - ratio_from_dB(change->a_dB));
}

void add(const Change& change, double order, Look& look) {
  look.point = change.point;
  look.channel = change.channel;
  if (change.word == ChangeWord::changed) {
    look.changed.push_back(&change);
  } else {
    look.highest_order = std::max(look.highest_order, order);
  }
}

void complete(const Comparison& comparison, Look& look) {
  std::ranges::stable_sort(look.changed, std::greater<>(), to_be_seen);
  if (look.changed.size() > most_marks) look.changed.resize(most_marks);
  if (look.changed.empty()) return;
  look.most = to_be_seen(look.changed.front());
  look.highest_order = 0;
  for (const Change* change : look.changed) {
    const double order = comparison.quantities[change->quantity].order;
    look.highest_order = std::max(look.highest_order, order);
  }
}

std::vector<Look> looks_of(const Comparison& comparison) {
  std::map<std::pair<std::size_t, std::size_t>, Look> all;
  for (const Change& change : comparison.changes) {
    const analysis::Quantity& quantity = comparison.quantities[change.quantity];
    if (!quantity.is_line() || !change.seen) continue;
    add(change, quantity.order, all[{change.point, change.channel}]);
  }
  std::vector<Look> looks;
  for (auto& [place, look] : all) {
    complete(comparison, look);
    looks.push_back(std::move(look));
  }
  return looks;
}

// How many points there are at which a line changed.
std::size_t points_of(const std::vector<Look>& looks) {
  std::set<std::size_t> points;
  for (const Look& look : looks) {
    if (!look.changed.empty()) points.insert(look.point);
  }
  return points.size();
}

// Of each point the channel with most to be seen, of points those with most.
std::vector<Look> chosen(std::vector<Look> looks) {
  std::ranges::stable_sort(looks, std::greater<>(), &Look::most);
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
  const PlotAxis y =
      axis_around(unit.empty() ? "amplitude [unit not stated]" : "acceleration [" + unit + "]",
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
  std::size_t shown = 0;
  const std::vector<Look> looks = looks_of(comparison);
  for (const Look& look : chosen(looks)) {
    const auto pair = spectra(look.point, comparison.channels[look.channel].name);
    if (!pair) continue;
    body += heading_of(look, comparison) + pair_of_figures(look, *pair, comparison);
    ++shown;
  }
  if (body.empty()) return "";
  const std::size_t changed = points_of(looks);
  const std::string others =
      changed <= shown
          ? ""
          : fmt::format(" Lines changed at {} points; shown are {} of them.", changed, shown);
  return section(
      "Spectra before and after",
      paragraph("Amplitude over orders of the input shaft of " + facts.kinematics.machine +
                ", averaged in power over the repeats. Of each point the channel in "
                "which most changed; marked are the lines that did, the five strongest." +
                others) +
          body);
}

}  // namespace rvbench::bench::report
