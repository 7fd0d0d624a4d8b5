#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "analysis/diagnosis.hpp"
#include "analysis/emd/emd.hpp"
#include "analysis/envelope_spectra.hpp"
#include "analysis/evidence/record_evidence.hpp"
#include "analysis/indicators/channel_indicators.hpp"
#include "analysis/indicators/envelope_levels.hpp"
#include "analysis/indicators/hysteresis_record.hpp"
#include "analysis/indicators/shaft_indicators.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "analysis/quality/same_samples.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/spectral_lines.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_periods = lines_to_part;  // to part lines one period's order apart
constexpr double relevant_correlation = 0.1;      // an IMF below it says nothing about the signal

// What one channel came to.
struct ChannelResult {
  ChannelExamination examination;
  std::vector<SignatureComb> combs;       // empty where no period of the gear train fits
  std::vector<ChannelEvidence> evidence;  // one per comb
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
  return std::ranges::any_of(notes, &QualityNote::invalidates);
}

void describe_signal(const Channel& channel, ChannelExamination& e) {
  const SignalLevels levels = signal_levels(channel.samples);
  e.name = channel.info.name;
  e.unit = channel.info.unit;
  e.rms = levels.rms;
  e.peak = levels.peak;
  e.kurtosis = levels.kurtosis;
}

// Depths of the IMFs are weighed by the share of the signal that each carries, so that a strong
// modulation of a mode that hardly is there does not count.
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
  for (const std::size_t k : relevant) {
    const EnvelopeSpectra envelope =
        envelope_spectra(modes.imfs.col(static_cast<Eigen::Index>(k)), channel.rate_Hz,
                         channel.start_s, task.angle, task.kinematics.period_turns);
    if (!(envelope.mean > 0)) return;
    if (out.combs.empty()) {
      out.combs = signature_combs(task.kinematics, envelope.whole.resolution);
      out.evidence.resize(out.combs.size());
    }
    const double share = correlations[k] * correlations[k] / total_share;
    for (std::size_t s = 0; s < out.combs.size(); ++s) {
      out.evidence[s].add(comb_evidence(envelope, out.combs[s]), static_cast<int>(k) + 1, share);
    }
    levels.add(envelope, share);
  }
  std::ranges::move(levels.indicators(), std::back_inserter(out.examination.indicators));
}

ChannelResult examine_channel(const Channel& channel, std::vector<QualityNote> quality,
                              const Task& task) {
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
  ChannelIndicators indicators =
      channel_indicators(channel, lines, task.kinematics, out.examination.lines);
  out.examination.indicators = std::move(indicators.list);
  out.examination.residuals = std::move(indicators.residuals);
  read_imfs(channel, modes, task, out);
  return out;
}

// Whether lines of two channels' envelopes lie at the same orders.
bool alike(const ChannelResult& a, const ChannelResult& b) {
  const auto resolution = [](const ChannelResult& r) {
    return r.combs.empty() ? 0 : r.combs.front().resolution;
  };
  return a.combs.size() == b.combs.size() &&
         std::abs(resolution(a) - resolution(b)) < 1e-6 * resolution(b);
}

// Evidence of the channels that span the most periods: only theirs can be added.
void score(std::vector<ChannelResult>& results, Examination& e) {
  const ChannelResult* longest = nullptr;
  for (const ChannelResult& result : results) {
    if (!result.combs.empty() && (longest == nullptr || result.periods > longest->periods)) {
      longest = &result;
    }
  }
  if (longest == nullptr) return;
  e.periods = longest->periods;
  std::vector<std::vector<ChannelEvidence>> evidence;
  for (ChannelResult& result : results) {
    const bool counts = alike(result, *longest) && !result.repeats_another;
    if (!counts && !result.repeats_another && !is_spoiled(result.quality)) {
      result.quality.push_back(
          {result.examination.name, "shorter than the longest channel: not weighed", false});
    }
    evidence.push_back(counts ? std::move(result.evidence)
                              : std::vector<ChannelEvidence>(longest->combs.size()));
  }
  e.scores = score_signatures(evidence, longest->combs);
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

void gather(std::vector<ChannelResult> results, Examination& e) {
  score(results, e);
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
  const std::optional<ShaftAngle> angle = ShaftAngle::of(record);
  if (!angle) {
    e.quality.push_back({record.source, "the shaft's speed is not known or not steady", true});
    return e;
  }
  e.angle_measured = angle->is_measured();
  if (e.angle_measured || !std::isfinite(e.speed_rpm)) {
    const double direction = e.speed_rpm < 0 ? -1 : 1;
    e.speed_rpm = direction * units::rpm_from_Hz(angle->mean_speed_Hz());
  }

  std::vector<ChannelResult> results(channels.size());
  const Task task{kinematics, *angle, options};
  std::vector<std::vector<QualityNote>> quality =
      record_quality(channels, *angle, kinematics, options.clip_level);
  parallel_for(channels.size(), [&](std::size_t i) {
    results[i] = examine_channel(*channels[i], std::move(quality[i]), task);
  });
  mark_repeated(channels, results);
  gather(std::move(results), e);
  tell_unplaced(*angle, kinematics, e);
  e.indicators = shaft_indicators(record, *angle, kinematics);
  e.resolvable = e.periods >= fewest_periods;
  tell_why_unresolvable(record.source, channels, task, e);
  return e;
}

}  // namespace rvbench::analysis
