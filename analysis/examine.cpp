#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <utility>

#include "analysis/diagnosis.hpp"
#include "analysis/emd/emd.hpp"
#include "analysis/envelope_spectra.hpp"
#include "analysis/evidence/article_reading.hpp"
#include "analysis/evidence/gear_evidence.hpp"
#include "analysis/evidence/residual_envelope.hpp"
#include "analysis/evidence/rolling_evidence.hpp"
#include "analysis/indicators/channel_indicators.hpp"
#include "analysis/indicators/envelope_levels.hpp"
#include "analysis/indicators/hysteresis_record.hpp"
#include "analysis/indicators/shaft_indicators.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/loud_tones.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "analysis/quality/same_samples.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/shaft_speed.hpp"
#include "analysis/spectral_lines.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_periods = lines_to_part;  // to part lines one period's order apart
constexpr double relevant_correlation = 0.1;      // an IMF below it says nothing about the signal

// Where the gears' lines are in the spectra of channels of one length and rate.
struct RecordPlaces {
  GearPlaces gears;
  GearPlaces noise;
  ResidualPlaces residual;
  std::vector<double> sound;  // orders that a sound machine has
};

// What one channel came to.
struct ChannelResult {
  ChannelExamination examination;
  std::shared_ptr<const RecordPlaces> places;
  std::vector<GearReading> gears;  // one per signature; none where no period of the gears fits
  std::vector<GearReading> noise;
  ResidualEnvelope residual;
  std::optional<ArticleReading> article;
  std::vector<QualityNote> quality;
  double periods = 0;
  bool repeats_another = false;  // sample by sample: what it shows is no evidence of its own
};

struct Task {
  const Kinematics& kinematics;
  const ShaftAngle& angle;
  const ExamineOptions& options;
};

bool is_spoiled(const std::vector<QualityNote>& notes) {
  return std::ranges::any_of(
      notes, [](const QualityNote& note) { return note.invalidates || note.leaves_out; });
}

// Channels that cannot be trusted are left out where enough others remain.
void leave_out_spoiled(std::vector<std::vector<QualityNote>>& quality, int may_fail) {
  constexpr std::ptrdiff_t fewest = 4;
  const auto all = std::ssize(quality);
  const auto spoiled = std::ranges::count_if(quality, is_spoiled);
  if (spoiled > may_fail || all - spoiled < fewest || 3 * (all - spoiled) < 2 * all) return;
  for (std::vector<QualityNote>& notes : quality) {
    for (QualityNote& note : notes) {
      if (!note.invalidates) continue;
      note.invalidates = false;
      note.leaves_out = true;
    }
  }
}

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

// The highest order that the squared envelope is asked for.
double highest_envelope(const Kinematics& kinematics) {
  double highest = 0;
  for (const Signature& part : kinematics.signatures) {
    const double harmonics = part.shows == Shows::as_blows ? 6.5 : part.harmonics + 1;
    highest = std::max(highest, harmonics * part.order);
  }
  return highest;
}

// Lines that may tell the speed: the meshes' first harmonics; as their paths spread them where
// equal planets cancel them; and their second.
std::vector<std::vector<double>> witnesses_of(const Kinematics& kinematics, double top_order) {
  std::vector<double> first, beside, second;
  for (const GearMesh& mesh : kinematics.meshes) {
    if (2 * mesh.order + 1 > top_order) continue;
    first.push_back(mesh.order);
    second.push_back(2 * mesh.order);
    if (!(mesh.path_order > 0)) continue;
    beside.push_back(mesh.order - mesh.path_order);
    beside.push_back(mesh.order + mesh.path_order);
  }
  std::vector<std::vector<double>> witnesses;
  for (const std::vector<double>& orders : {first, second, beside}) {
    if (!orders.empty()) witnesses.push_back(orders);
  }
  if (first.size() > 1) {
    for (const double alone : first) witnesses.push_back({alone});  // the others may be silent
  }
  return witnesses;
}

// A stated speed, corrected by how far the meshes' lines are off it; empty where they are not seen
// surely enough to place all that belongs to them.
std::optional<ShaftAngle> corrected_by_lines(const std::vector<const Channel*>& channels,
                                             const std::vector<std::vector<QualityNote>>& quality,
                                             const ShaftAngle& stated,
                                             const Kinematics& kinematics) {
  std::vector<Channel> sound;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Channel& channel = *channels[i];
    if (is_spoiled(quality[i])) continue;
    if (sound.empty() || (channel.samples.size() == sound.front().samples.size() &&
                          channel.rate_Hz == sound.front().rate_Hz)) {
      sound.push_back(channel);
    }
  }
  if (sound.empty()) return {};
  const double rate_Hz = sound.front().rate_Hz;
  const Eigen::Index samples = sound.front().samples.size();
  constexpr Eigen::Index fewest_samples = 4096;
  if (samples < fewest_samples) return {};
  const double top_order = OrderLines::top_order_of(rate_Hz, stated);
  const double turns = stated.mean_speed_Hz() * static_cast<double>(samples) / rate_Hz;
  for (std::vector<double>& orders : witnesses_of(kinematics, top_order)) {
    const ShaftLines lines{.orders = std::move(orders),
                           .turns_per_sample = stated.mean_speed_Hz() / rate_Hz,
                           .within = 2 * stated_speed_error};
    const std::vector<ShaftSpeed> found = shaft_speeds(sound, lines, samples);
    if (found.empty() || !std::isfinite(found.front().turns_per_sample)) continue;
    const double off = found.front().standard_error / found.front().turns_per_sample;
    if (!(off * top_order * turns < same_line)) continue;
    return stated.geared(found.front().turns_per_sample / lines.turns_per_sample);
  }
  return {};
}

// Of each channel; channels that are alike share one. None where no period of the gears fits.
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

// The lines of a channel without loud tones; empty if it has none.
OrderLines quiet_lines(const Channel& channel, const OrderLines& lines,
                       const std::vector<double>& sound, const Task& task) {
  const auto from_gears = [&](double order) { return distance_from_gears(task.kinematics, order); };
  const auto quiet = without_loud_tones(channel, task.angle, lines, sound, from_gears);
  if (!quiet) return {};
  return {*quiet, task.angle, task.kinematics.period_turns};
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

// Whether lines of two channels lie at the same orders.
bool alike(const ChannelResult& a, const ChannelResult& b) {
  return a.places != nullptr && a.places == b.places;
}

// What the article alone would see, beside each score.
void add_article(const std::vector<const ChannelResult*>& counted, Examination& e) {
  for (std::size_t s = 0; s < e.scores.size(); ++s) {
    SignatureScore& score = e.scores[s];
    for (const ChannelResult* result : counted) {
      if (result->article) score.article_statistic += result->article->statistic(s);
    }
  }
}

// A printed frequency is looked for as the article does: the envelope that shows it most speaks for
// it, and pays for all that were asked.
void score_printed(const std::vector<ChannelResult>& results, const Kinematics& kinematics,
                   Examination& e) {
  for (SignatureScore& score : e.scores) {
    const auto s = static_cast<std::size_t>(score.signature);
    if (kinematics.signatures[s].shows != Shows::as_printed) continue;
    double highest = 0, envelopes = 0;
    for (std::size_t c = 0; c < results.size(); ++c) {
      if (!results[c].article || results[c].repeats_another) continue;
      const ArticleReading::Line& line = results[c].article->line(s);
      envelopes += results[c].article->envelopes();
      if (line.log_ratio <= highest) continue;
      highest = line.log_ratio;
      score.channel = static_cast<int>(c);
      score.order = line.order;
      score.depth = line.depth;
      score.line_orders = {line.order};
      score.line_depths = {line.depth};
    }
    score.p_value = std::min(1.0, envelopes * std::exp(-highest));
    score.log_likelihood_ratio = highest;
    score.smallest_visible = 0;
  }
}

// Evidence of the channels that span the most periods: only theirs can be added.
void score(std::vector<ChannelResult>& results, const Kinematics& kinematics, Examination& e) {
  const ChannelResult* longest = nullptr;
  for (const ChannelResult& result : results) {
    if (!result.gears.empty() && (longest == nullptr || result.periods > longest->periods)) {
      longest = &result;
    }
  }
  if (longest == nullptr) return;
  e.periods = longest->periods;
  std::vector<std::vector<GearReading>> gears;
  std::vector<std::vector<GearReading>> noise;
  std::vector<ResidualEnvelope> residuals;
  std::vector<const ChannelResult*> counted;
  const std::size_t noise_parts = longest->noise.size();
  for (ChannelResult& result : results) {
    const bool counts = alike(result, *longest) && !result.repeats_another;
    if (!counts && !result.repeats_another && !is_spoiled(result.quality)) {
      result.quality.push_back(
          {result.examination.name, "shorter than the longest channel: not weighed", false});
    }
    if (counts) counted.push_back(&result);
    gears.push_back(counts ? std::move(result.gears) : std::vector<GearReading>{});
    noise.push_back(counts && result.noise.size() == noise_parts ? std::move(result.noise)
                                                                 : std::vector<GearReading>{});
    residuals.push_back(counts ? std::move(result.residual) : ResidualEnvelope{});
  }
  score_gears(gears, longest->places->gears, e.scores);
  e.unknown = score_rolling(residuals, kinematics, e.scores);
  // Blows swing what is left with their shaft, and with all that carries it.
  const bool is_struck = std::ranges::any_of(e.scores, [&](const SignatureScore& score) {
    return kinematics.signatures[static_cast<std::size_t>(score.signature)].shows ==
               Shows::as_blows &&
           score.p_value < significant_p;
  });
  const bool is_quiet = !is_struck && e.unknown.empty();
  if (noise_parts > 0 && is_quiet) score_noise(noise, longest->places->noise, kinematics, e.scores);
  add_article(counted, e);
  score_printed(results, kinematics, e);
  for (SignatureScore& score : e.scores) {
    const auto& shown_by = results[static_cast<std::size_t>(score.channel)].article;
    if (shown_by) score.imf = shown_by->imf(static_cast<std::size_t>(score.signature));
  }
}

void mark_repeated(const std::vector<const Channel*>& channels,
                   std::vector<ChannelResult>& results) {
  const std::vector<std::size_t> first = first_of_same(channels);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    results[i].repeats_another = first[i] != i;
    if (first[i] == i || is_spoiled(results[i].quality)) continue;
    results[i].quality.push_back(
        {channels[i]->info.name,
         "the same samples as " + channels[first[i]]->info.name +
             ": one signal in two channels, weighed once; was one sensor not recorded?",
         false});
  }
}

void gather(std::vector<ChannelResult> results, const Kinematics& kinematics, Examination& e) {
  score(results, kinematics, e);
  for (ChannelResult& result : results) {
    for (QualityNote& note : result.quality) {
      note.where = e.source + ", " + note.where;
      e.quality.push_back(std::move(note));
    }
    e.channels.push_back(std::move(result.examination));
  }
}

// What indicators leave out for a speed that was stated, and why.
void tell_unplaced(const ShaftAngle& angle, const Kinematics& kinematics, Examination& e) {
  std::string meshes;
  for (const CharacteristicOrder& o : kinematics.orders) {
    if (!o.mesh) continue;
    if (is_placed(o.order, e.periods * kinematics.period_turns, speed_error(angle.is_measured()))) {
      continue;
    }
    meshes += (meshes.empty() ? "" : ", ") + o.name;
  }
  if (meshes.empty()) return;
  e.quality.push_back(
      {e.source,
       "no sideband ratio, FM0, FM4 and NA4 of " + meshes +
           ": the speed is stated, and no angle measured that would place its lines",
       false});
}

// A record is as long as its channels, also where none of them can be used.
void tell_why_unresolvable(const std::string& source, const std::vector<const Channel*>& channels,
                           const Task& task, Examination& e) {
  const double period_turns = task.kinematics.period_turns;
  double periods = 0;
  for (const Channel* channel : channels) {
    if (!(channel->rate_Hz > 0)) continue;
    periods = std::max(periods, task.angle.whole_periods(channel->samples.size(), channel->rate_Hz,
                                                         channel->start_s, period_turns));
  }
  if (periods >= fewest_periods) {
    if (!e.resolvable && std::ranges::none_of(e.quality, &QualityNote::invalidates)) {
      e.quality.push_back({source, "no channel has an envelope that could be read", true});
    }
    return;
  }
  e.quality.push_back(
      {source,
       fmt::format("too short: {:.0f} whole periods of the gear train, {:.0f} are needed to part "
                   "its orders: {:.3g} s at this speed",
                   std::floor(periods), fewest_periods,
                   fewest_periods * period_turns / task.angle.mean_speed_Hz()),
       true});
}

// A shaft that goes to and fro tells of the reducer's torsion, and nothing of what turns.
void examine_hysteresis(const Recording& record, const Kinematics& kinematics, Examination& e) {
  e.of_hysteresis = true;
  const Hysteresis told = hysteresis_of(record, kinematics);
  e.indicators = hysteresis_indicators(told);
  for (const std::string& why : told.cannot_tell) {
    e.quality.push_back({record.source, "cannot tell: " + why, e.indicators.empty()});
  }
}

// What the angle tells goes before what the record states.
void set_speed(const ShaftAngle& angle, bool by_lines, Examination& e) {
  e.angle_measured = angle.is_measured();
  if (!e.angle_measured && !by_lines && std::isfinite(e.speed_rpm)) return;
  const double direction = e.speed_rpm < 0 ? -1 : 1;
  e.speed_rpm = direction * units::rpm_from_Hz(angle.mean_speed_Hz());
}

}  // namespace

Examination examine(const Recording& record, const Kinematics& kinematics,
                    const ExamineOptions& options) {
  Examination e;
  e.source = record.source;
  e.speed_rpm = record.speed_rpm;
  e.load_pct = record.load_pct;
  e.repeat = record.repeat;
  for (const Signature& signature : kinematics.signatures) {
    SignatureScore& score = e.scores.emplace_back();
    score.signature = static_cast<int>(e.scores.size()) - 1;
    score.order = signature.order;
  }
  if (is_hysteresis_test(record)) {
    examine_hysteresis(record, kinematics, e);
    return e;
  }
  const std::vector<const Channel*> channels = acceleration_channels(record);
  if (channels.empty()) {
    e.quality.push_back({record.source, "no acceleration channel", true});
    return e;
  }
  const std::optional<ShaftAngle> told = ShaftAngle::of(record);
  if (!told) {
    e.quality.push_back({record.source, "the shaft's speed is not known or not steady", true});
    return e;
  }
  std::vector<std::vector<QualityNote>> quality =
      record_quality(channels, *told, kinematics, options.clip_level);
  std::optional<ShaftAngle> by_lines;
  if (!told->is_measured()) by_lines = corrected_by_lines(channels, quality, *told, kinematics);
  const ShaftAngle& angle = by_lines ? *by_lines : *told;
  set_speed(angle, by_lines.has_value(), e);

  std::vector<ChannelResult> results(channels.size());
  const bool is_placed = angle.is_measured() || by_lines.has_value();
  const Task task{kinematics, angle, options};
  const auto places = places_of(channels, angle, is_placed, kinematics);
  leave_out_spoiled(quality, options.channels_may_fail);
  parallel_for(channels.size(), [&](std::size_t i) {
    results[i] = examine_channel(*channels[i], std::move(quality[i]), places[i], task);
  });
  mark_repeated(channels, results);
  gather(std::move(results), kinematics, e);
  tell_unplaced(angle, kinematics, e);
  e.indicators = shaft_indicators(record, angle, kinematics);
  e.resolvable = e.periods >= fewest_periods;
  tell_why_unresolvable(record.source, channels, task, e);
  return e;
}

}  // namespace rvbench::analysis
