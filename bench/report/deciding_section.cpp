#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/evidence/residual_envelope.hpp"
#include "analysis/shaft_angle.hpp"
#include "bench/report/html.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/xml_text.hpp"

namespace rvbench::bench::report {
namespace {

constexpr std::size_t most_shown = 3;
constexpr std::size_t most_marked = 8;

// Where a part shows most: the point, the channel, and the lines.
struct Deciding {
  const analysis::Finding& finding;
  const analysis::Signature& signature;
  std::size_t point = 0;
  const analysis::SignatureScore* score = nullptr;

  bool is_in_envelope() const {
    return score->by_noise || signature.shows == analysis::Shows::as_blows;
  }
};

std::optional<Deciding> deciding(const analysis::Finding& finding, const ReportInput& input) {
  const auto& signatures = input.kinematics.signatures;
  const auto signature = std::ranges::find_if(signatures, [&](const analysis::Signature& s) {
    return s.component == finding.component && s.mechanism == finding.mechanism;
  });
  if (signature == signatures.end()) return {};
  Deciding most{finding, *signature};
  const auto s = static_cast<std::size_t>(signature - signatures.begin());
  const std::vector<JudgedPoint>& points = input.judgement.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto& scores = points[i].examination.scores;
    const auto& source = points[i].examination.source;
    if (s >= scores.size() || scores[s].line_orders.empty()) continue;
    if (std::ranges::find(finding.points, source) == finding.points.end()) continue;
    if (most.score != nullptr && scores[s].depth <= most.score->depth) continue;
    most.point = i;
    most.score = &scores[s];
  }
  if (most.score == nullptr) return {};
  return most;
}

// The spectrum that the part was read from.
analysis::Spectrum spectrum_of(const Deciding& d, const Channel& channel, Recording record,
                               const ReportInput& input) {
  record.speed_rpm = input.judgement.points[d.point].examination.speed_rpm;
  const auto angle = analysis::ShaftAngle::of(record);
  if (!angle) return {};
  const analysis::OrderLines lines(channel, *angle, input.kinematics.period_turns);
  if (lines.empty()) return {};
  if (!d.is_in_envelope()) return lines.spectrum();
  const double highest = 1.1 * std::ranges::max(d.score->line_orders);
  const auto places =
      analysis::residual_places(lines.turns(), lines.top_order(), input.kinematics, highest);
  return analysis::residual_envelope(lines, places).windowed;
}

std::string figure_of(const Deciding& d, const ReportInput& input) {
  const std::optional<Recording> record = input.load(d.point);
  const auto& channels = input.judgement.points[d.point].examination.channels;
  if (!record || static_cast<std::size_t>(d.score->channel) >= channels.size()) return "";
  const Channel* channel = record->find(channels[static_cast<std::size_t>(d.score->channel)].name);
  if (channel == nullptr || channel->samples.size() < 16 || !channel->samples.allFinite())
    return "";
  const analysis::Spectrum spectrum = spectrum_of(d, *channel, *record, input);
  if (spectrum.amplitude.size() < 16) return "";

  const auto [low, high] = std::ranges::minmax(d.finding.line_orders);
  const double air = std::max(0.5, 0.05 * (high - low));
  const auto lines = static_cast<double>(spectrum.amplitude.size() - 1);
  const double from = std::max(0.0, low - air),
               to = std::min(high + air, lines * spectrum.resolution);
  const auto first = static_cast<Eigen::Index>(from / spectrum.resolution);
  const auto count = static_cast<Eigen::Index>(to / spectrum.resolution) - first + 1;
  if (count < 2) return "";
  const auto band = spectrum.amplitude.segment(first, count);
  const std::string unit = d.is_in_envelope() ? "depth of the power left without gears"
                                              : "amplitude [" + channel->info.unit + "]";
  SvgPlot plot(spoken(d.finding.component) + ": " + channel->info.name,
               {"order of the input shaft", from, to}, axis_around(unit, band));
  plot.add_trace(static_cast<double>(first) * spectrum.resolution, spectrum.resolution, band);
  for (std::size_t i = 0; i < std::min(most_marked, d.finding.line_orders.size()); ++i) {
    const double order = d.finding.line_orders[i];
    plot.add_mark(order, order_text(order, input.kinematics.period_turns));
  }
  return "<h3>" + xml_escaped(caption_of(input.judgement.points[d.point])) +
         "</h3>\n<figure style=\"margin:0\">" + plot.svg() + "</figure>\n";
}

}  // namespace

std::string deciding_section(const ReportInput& input) {
  if (!input.load) return "";
  std::string figures;
  std::size_t shown = 0;
  const analysis::Diagnosis& diagnosis = input.judgement.diagnosis;
  for (const auto* list : {&diagnosis.findings, &diagnosis.below_limit}) {
    for (const analysis::Finding& finding : *list) {
      if (shown == most_shown) break;
      const auto found = deciding(finding, input);
      const std::string figure = found ? figure_of(*found, input) : "";
      if (figure.empty()) continue;
      figures += figure;
      ++shown;
    }
  }
  if (figures.empty()) return "";
  return section("What decided",
                 paragraph("The channel and the point that show a part most, over the orders of "
                           "its deepest lines, which are marked.") +
                     figures);
}

}  // namespace rvbench::bench::report
