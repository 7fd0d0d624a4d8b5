#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/emd/emd.hpp"
#include "analysis/hilbert.hpp"
#include "analysis/spectrum.hpp"
#include "bench/report/html.hpp"
#include "bench/report/order_spectrum.hpp"
#include "bench/report/sections.hpp"
#include "bench/report/svg_plot.hpp"
#include "bench/xml_text.hpp"
#include "hal/types/units.hpp"

namespace rvbench::bench::report {
namespace {

constexpr int imfs_with_spectrum = 5;  // as the article: IMF 1 to 5 carry the signal
constexpr double imf_window_s = 2;
constexpr double envelope_orders = 4.5;

// One channel of one representative point, loaded.
struct Shown {
  const JudgedPoint& point;
  const Recording& record;
  const Channel& channel;
  const analysis::Kinematics& kinematics;

  std::string quantity() const {
    return channel.info.unit.empty() ? "signal" : "acceleration [" + channel.info.unit + "]";
  }
  // As it was examined: a record with a shaft angle need not state a speed.
  double turns_per_s() const { return units::Hz_from_rpm(std::abs(point.examination.speed_rpm)); }
};

std::string figure(const SvgPlot& plot) {
  return "<figure style=\"margin:0\">" + plot.svg() + "</figure>\n";
}

std::string time_figure(const Shown& shown) {
  const Eigen::VectorXd& x = shown.channel.samples;
  const double length_s = double(x.size()) / shown.channel.rate_Hz;
  SvgPlot plot("Time: " + shown.channel.info.name, {"time [s]", 0, length_s},
               axis_around(shown.quantity(), x));
  plot.add_trace(0, 1 / shown.channel.rate_Hz, x);
  return figure(plot);
}

// What an envelope spectrum marks. Orders close to 0 would only crowd its left edge; of a gear
// train, only lines that repeat with it.
bool is_marked(const analysis::CharacteristicOrder& line, const analysis::Kinematics& kinematics) {
  return line.order > 0.05 && (kinematics.period_turns <= 1 || !line.fraction.empty());
}

// Labels of nearby orders are long; plots show the fraction or the number.
std::string mark_text(const analysis::CharacteristicOrder& line) {
  return line.fraction.empty() ? line.name : line.fraction;
}

std::string spectrum_figure(const Shown& shown) {
  const Channel& channel = shown.channel;
  const auto spectrum =
      analysis::amplitude_spectrum(channel.samples, channel.rate_Hz, analysis::Window::hann);
  SvgPlot plot("Spectrum: " + channel.info.name, {"frequency [Hz]", 0, channel.rate_Hz / 2},
               axis_around(shown.quantity(), spectrum.amplitude));
  plot.add_trace(0, spectrum.resolution, spectrum.amplitude);
  for (const analysis::CharacteristicOrder& line : shown.kinematics.orders) {
    // What is nearer than a hair to the left edge is marked in the envelope spectra.
    const double frequency_Hz = line.order * shown.turns_per_s();
    if (frequency_Hz > 0.02 * channel.rate_Hz) plot.add_mark(frequency_Hz, line.name);
  }
  return figure(plot);
}

std::string imf_figure(const Shown& shown, const Eigen::VectorXd& imf, int number) {
  const double length_s = std::min(imf_window_s, double(imf.size()) / shown.channel.rate_Hz);
  const auto count = static_cast<Eigen::Index>(length_s * shown.channel.rate_Hz);
  SvgPlot plot(fmt::format("IMF {}", number), {"time [s]", 0, length_s},
               axis_around(shown.channel.info.unit, imf.head(count)), 540, 180);
  plot.add_trace(0, 1 / shown.channel.rate_Hz, imf.head(count));
  return figure(plot);
}

std::string envelope_figure(const Shown& shown, const Eigen::VectorXd& imf, int number) {
  const auto spectrum = order_spectrum(analysis::envelope(imf), shown.channel, shown.record);
  const auto lines =
      std::min<Eigen::Index>(spectrum.amplitude.size(),
                             static_cast<Eigen::Index>(envelope_orders / spectrum.resolution) + 1);
  SvgPlot plot(fmt::format("Envelope spectrum of IMF {}", number),
               {"order of the input shaft", 0, envelope_orders},
               axis_around(shown.channel.info.unit, spectrum.amplitude.head(lines)), 540, 180);
  plot.add_trace(0, spectrum.resolution, spectrum.amplitude.head(lines));
  for (const analysis::CharacteristicOrder& line : shown.kinematics.orders) {
    if (is_marked(line, shown.kinematics)) plot.add_mark(line.order, mark_text(line));
  }
  for (double harmonic = 2; harmonic < envelope_orders; ++harmonic)
    plot.add_mark(harmonic, fmt::format("{:.0f}", harmonic));
  return figure(plot);
}

double length_s(const Shown& shown) {
  return double(shown.channel.samples.size()) / shown.channel.rate_Hz;
}

std::string imf_figures(const Shown& shown) {
  const analysis::Emd modes = analysis::emd(shown.channel.samples);
  std::string html = "<h3>IMFs and envelope spectra: " + xml_escaped(caption_of(shown.point)) +
                     ", " + xml_escaped(shown.channel.info.name) +
                     "</h3>\n<div class=\"figures\">\n";
  for (Eigen::Index k = 0; k < modes.imfs.cols(); ++k) {
    const Eigen::VectorXd imf = modes.imfs.col(k);
    const int number = static_cast<int>(k) + 1;
    html += imf_figure(shown, imf, number);
    const bool has_orders = shown.turns_per_s() * length_s(shown) > 1;
    if (number <= imfs_with_spectrum && has_orders) html += envelope_figure(shown, imf, number);
  }
  return html + "</div>\n";
}

// IMFs are shown without load, as in the article, and for every file that is no matrix point.
bool shows_imfs(const std::vector<std::size_t>& chosen, std::size_t at,
                const Judgement& judgement) {
  const double speed = judgement.points[chosen[at]].planned_speed_rpm;
  return at == 0 || std::isnan(speed) ||
         judgement.points[chosen[at - 1]].planned_speed_rpm != speed;
}

}  // namespace

std::string signal_section(const ReportInput& input) {
  if (!input.load) return "";
  const std::vector<std::size_t> chosen = representative_points(input.judgement);
  std::string signals;
  std::string imfs;
  for (std::size_t at = 0; at < chosen.size(); ++at) {
    const JudgedPoint& point = input.judgement.points[chosen[at]];
    const std::optional<Recording> record = input.load(chosen[at]);
    if (!record) continue;
    const Channel* channel =
        record->find(point.examination.channels[shown_channel(point.examination)].name);
    // Gaps and stubs are named among the quality notes; there is nothing to transform in them.
    if (channel == nullptr || channel->samples.size() < 16 || !channel->samples.allFinite())
      continue;
    const Shown shown{point, *record, *channel, input.kinematics};
    signals += "<h3>" + xml_escaped(caption_of(point)) + "</h3>\n<div class=\"figures\">\n" +
               time_figure(shown) + spectrum_figure(shown) + "</div>\n";
    if (shows_imfs(chosen, at, input.judgement)) imfs += imf_figures(shown);
  }
  if (!signals.empty()) {
    signals =
        shown_points(input.judgement, "rvbench export writes the samples of any point.") + signals;
  }
  return section("Signals of representative points", signals) +
         section("Empirical mode decomposition",
                 imfs.empty()
                     ? ""
                     : paragraph("Each IMF over its first seconds; envelope spectra of the whole "
                                 "record over orders of the measured shaft angle. Of several "
                                 "points at one planned speed, the one with the least load.") +
                           imfs);
}

}  // namespace rvbench::bench::report
