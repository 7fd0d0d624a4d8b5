#include "analysis/examine_channel.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "analysis/emd/emd.hpp"
#include "analysis/envelope_spectra.hpp"
#include "analysis/evidence/blow_phases.hpp"
#include "analysis/evidence/gear_combs.hpp"
#include "analysis/indicators/channel_indicators.hpp"
#include "analysis/indicators/envelope_levels.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/loud_tones.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/spectral_lines.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double relevant_correlation = 0.1;  // an IMF below it says nothing about the signal

void describe_signal(const Channel& channel, ChannelExamination& e) {
  const SignalLevels levels = signal_levels(channel.samples);
  e.name = channel.info.name;
  e.unit = channel.info.unit;
  e.rms = levels.rms;
  e.peak = levels.peak;
  e.kurtosis = levels.kurtosis;
}

// Envelopes of the IMFs that say something about the signal, weighed by the share of it that each
// carries.
void read_imfs(const Channel& channel, const Emd& modes, const Task& task, ChannelResult& out) {
  const std::vector<double>& correlations = out.examination.imf_correlation;
  std::vector<std::size_t> relevant;
  double total_share = 0;
  for (std::size_t k = 0; k < correlations.size(); ++k) {
    if (correlations[k] < relevant_correlation) continue;
    relevant.push_back(k);
    total_share += correlations[k] * correlations[k];
  }
  EnvelopeLevels levels(task.kinematics, speed_error(task.angle.is_measured()));
  ArticleReading& article = out.article.emplace(task.kinematics);
  for (const std::size_t k : relevant) {
    const EnvelopeSpectra envelope =
        envelope_spectra(modes.imfs.col(static_cast<Eigen::Index>(k)), channel.rate_Hz,
                         channel.start_s, task.angle, task.kinematics.period_turns);
    if (!(envelope.mean > 0)) return;
    article.add(envelope, static_cast<int>(k) + 1);
    levels.add(envelope, correlations[k] * correlations[k] / total_share);
  }
  std::ranges::move(levels.indicators(), std::back_inserter(out.examination.indicators));
}

// The highest order that the squared envelope is asked for. Blows are asked for four harmonics,
// their decoys lie up to 1.45 times as high, and sidebands beside both.
double highest_envelope(const Kinematics& kinematics) {
  constexpr double highest_blows = 6.5;
  double highest = 0;
  for (const Signature& part : kinematics.signatures) {
    const double harmonics = part.shows == Shows::as_blows ? highest_blows : part.harmonics + 1;
    highest = std::max(highest, harmonics * part.order);
  }
  return highest;
}

// The lines of a channel without loud tones; empty if it has none.
OrderLines quiet_lines(const Channel& channel, const OrderLines& lines,
                       const std::vector<double>& sound, const Task& task) {
  const auto from_gears = [&](double order) { return distance_from_gears(task.kinematics, order); };
  const auto quiet = without_loud_tones(channel, task.angle, lines, sound, from_gears);
  if (!quiet) return {};
  return {*quiet, task.angle, task.kinematics.period_turns};
}

}  // namespace

bool is_spoiled(const std::vector<QualityNote>& notes) {
  return std::ranges::any_of(
      notes, [](const QualityNote& note) { return note.invalidates || note.leaves_out; });
}

std::vector<std::shared_ptr<const RecordPlaces>> places_of(
    const std::vector<const Channel*>& channels, const ShaftAngle& angle, bool is_placed,
    const Kinematics& kinematics) {
  struct Made {
    double turns, top_order;
    std::shared_ptr<const RecordPlaces> places;
  };
  std::vector<Made> made;
  std::vector<std::shared_ptr<const RecordPlaces>> all;
  for (const Channel* channel : channels) {
    std::shared_ptr<const RecordPlaces>& places = all.emplace_back();
    if (!(channel->rate_Hz > 0)) continue;
    const double period = kinematics.period_turns;
    const double turns = period * angle.whole_periods(channel->samples.size(), channel->rate_Hz,
                                                      channel->start_s, period);
    const double top_order = OrderLines::top_order_of(channel->rate_Hz, angle);
    if (!(turns > 0)) continue;
    const auto alike = std::ranges::find_if(made, [&](const Made& other) {
      return other.turns == turns && other.top_order == top_order;
    });
    if (alike != made.end()) {
      places = alike->places;
      continue;
    }
    const auto lines = envelope_lines(turns, top_order, highest_envelope(kinematics));
    auto of_channel = std::make_shared<RecordPlaces>();
    of_channel->residual =
        residual_places(turns, top_order, kinematics, highest_envelope(kinematics));
    of_channel->sound = sound_lines(kinematics, top_order);
    of_channel->gears = line_places(turns, top_order, angle.mean_speed_Hz(), is_placed, kinematics);
    if (lines > 0) {
      of_channel->noise = envelope_places(kinematics, 1 / turns, static_cast<std::size_t>(lines));
    }
    places = of_channel;
    made.push_back({turns, top_order, places});
  }
  return all;
}

ChannelResult examine_channel(const Channel& channel, std::vector<QualityNote> quality,
                              std::shared_ptr<const RecordPlaces> places, const Task& task) {
  ChannelResult out;
  out.quality = std::move(quality);
  out.examination.name = channel.info.name;
  out.examination.unit = channel.info.unit;
  if (is_spoiled(out.quality)) return out;

  describe_signal(channel, out.examination);
  const Emd modes = emd(channel.samples, {.imfs = task.options.imfs, .sifts = task.options.sifts});
  for (Eigen::Index k = 0; k < modes.imfs.cols(); ++k) {
    out.examination.imf_correlation.push_back(correlation(modes.imfs.col(k), channel.samples));
  }
  out.periods = task.angle.whole_periods(channel.samples.size(), channel.rate_Hz, channel.start_s,
                                         task.kinematics.period_turns);
  const OrderLines lines(channel, task.angle, task.kinematics.period_turns);
  out.examination.lines = spectral_lines(lines, task.kinematics);
  if (places != nullptr) {
    const OrderLines without_tones = quiet_lines(channel, lines, places->sound, task);
    const OrderLines& quiet = without_tones.empty() ? lines : without_tones;
    out.residual = residual_envelope(quiet, places->residual);
    const auto held = [](const GearPlaces& gears, Eigen::Index in_spectrum) {
      return !gears.parts.empty() && std::ssize(gears.locked) <= in_spectrum;
    };
    const Spectrum& spectrum = quiet.spectrum();
    if (held(places->gears, spectrum.amplitude.size())) {
      out.places = places;
      out.gears = read_gears(spectrum, places->gears);
      const std::vector<double> phases = blow_phases(quiet, places->gears, task.kinematics);
      for (std::size_t s = 0; s < phases.size(); ++s) out.gears[s].in_phase = phases[s];
    }
    const Spectrum& swings = out.residual.windowed;
    if (held(places->noise, swings.amplitude.size())) out.noise = read_noise(swings, places->noise);
  }
  ChannelIndicators indicators =
      channel_indicators(channel, lines, task.kinematics, out.examination.lines);
  out.examination.indicators = std::move(indicators.list);
  out.examination.residuals = std::move(indicators.residuals);
  read_imfs(channel, modes, task, out);
  return out;
}

}  // namespace rvbench::analysis
