#include <algorithm>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "analysis/emd/emd.hpp"
#include "analysis/envelope_lines.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/signature_lines.hpp"
#include "analysis/spectral_lines.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_periods = lines_to_part;  // to part lines one period's order apart
constexpr double relevant_correlation = 0.1;      // an IMF below it says nothing about the signal

// What one channel came to.
struct ChannelResult {
  ChannelExamination examination;
  std::vector<SignatureScore> scores;  // one per signature
  std::vector<QualityNote> quality;
  double periods = 0;
};

struct Task {
  const Kinematics& kinematics;
  const ShaftAngle& angle;
  const ExamineOptions& options;
};

void describe_signal(const Channel& channel, ChannelExamination& e) {
  const SignalLevels levels = signal_levels(channel.samples);
  e.name = channel.info.name;
  e.unit = channel.info.unit;
  e.rms = levels.rms;
  e.peak = levels.peak;
  e.kurtosis = levels.kurtosis;
}

// Depths of the IMFs are weighed by the share of the signal that each carries, so that a strong
// modulation of a mode that hardly is there does not count; the p-value is the best IMF's.
void weigh(SignatureScore& total, const FamilyScore& score, int imf, double share) {
  if (total.line_depths.empty()) total.line_depths.assign(score.line_depths.size(), 0.0);
  for (std::size_t i = 0; i < score.line_depths.size(); ++i) {
    total.line_depths[i] += share * score.line_depths[i] * score.line_depths[i];
  }
  total.depth += share * score.depth * score.depth;
  if (total.imf == 0 || score.p_value < total.p_value ||
      (score.p_value == total.p_value && score.statistic > total.statistic)) {
    total.imf = imf;
    total.order = score.order;
    total.statistic = score.statistic;
    total.p_value = score.p_value;
  }
}

void score_imfs(const Channel& channel, const Emd& modes, const Task& task, ChannelResult& out) {
  const std::vector<double>& correlations = out.examination.imf_correlation;
  std::vector<int> relevant;
  double total_share = 0;
  for (int k = 0; k < static_cast<int>(correlations.size()); ++k) {
    const double c = correlations[static_cast<std::size_t>(k)];
    if (c < relevant_correlation) continue;
    relevant.push_back(k);
    total_share += c * c;
  }
  std::vector<std::vector<SignatureLine>> lines;
  for (const int k : relevant) {
    const EnvelopeSpectra envelope =
        envelope_spectra(modes.imfs.col(k), channel.rate_Hz, channel.start_s, task.angle,
                         task.kinematics.period_turns);
    if (!(envelope.mean > 0)) return;
    if (lines.empty()) lines = signature_lines(task.kinematics, envelope.whole.resolution);
    const double c = correlations[static_cast<std::size_t>(k)];
    const std::vector<FamilyScore> scores =
        score_families(envelope, task.kinematics.signatures, lines);
    for (std::size_t s = 0; s < scores.size(); ++s) {
      weigh(out.scores[s], scores[s], k + 1, c * c / total_share);
    }
  }
  for (std::size_t s = 0; s < out.scores.size(); ++s) {
    SignatureScore& score = out.scores[s];
    score.depth = std::sqrt(score.depth);
    const auto searched = std::max<std::size_t>(relevant.size(), 1);
    score.p_value = std::min(1.0, score.p_value * static_cast<double>(searched));
    for (double& depth : score.line_depths) depth = std::sqrt(depth);
    if (lines.empty()) continue;
    for (const SignatureLine& line : lines[s]) score.line_orders.push_back(line.order);
  }
}

ChannelResult examine_channel(const Channel& channel, std::vector<QualityNote> quality,
                              const Task& task) {
  ChannelResult out;
  out.quality = std::move(quality);
  out.examination.name = channel.info.name;
  out.examination.unit = channel.info.unit;
  out.scores.resize(task.kinematics.signatures.size());
  if (!out.quality.empty()) return out;

  describe_signal(channel, out.examination);
  const Emd modes = emd(channel.samples, {.imfs = task.options.imfs, .sifts = task.options.sifts});
  for (Eigen::Index k = 0; k < modes.imfs.cols(); ++k) {
    out.examination.imf_correlation.push_back(correlation(modes.imfs.col(k), channel.samples));
  }
  out.periods = task.angle.whole_periods(channel.samples.size(), channel.rate_Hz, channel.start_s,
                                         task.kinematics.period_turns);
  score_imfs(channel, modes, task, out);
  out.examination.lines = spectral_lines(channel, task.angle, task.kinematics);
  return out;
}

// The channel where a signature is deepest speaks for it; its p-value pays for the choice.
void keep_best(std::vector<SignatureScore>& best, const ChannelResult& result, int channel) {
  for (std::size_t s = 0; s < best.size(); ++s) {
    best[s].signature = static_cast<int>(s);
    if (channel > 0 && !(result.scores[s].depth > best[s].depth)) continue;
    best[s] = result.scores[s];
    best[s].signature = static_cast<int>(s);
    best[s].channel = channel;
  }
}

void gather(std::vector<ChannelResult> results, Examination& e) {
  for (std::size_t i = 0; i < results.size(); ++i) {
    keep_best(e.scores, results[i], static_cast<int>(i));
    e.periods = std::max(e.periods, results[i].periods);
    for (QualityNote& note : results[i].quality) {
      note.where = e.source + ", " + note.where;
      e.quality.push_back(std::move(note));
    }
    e.channels.push_back(std::move(results[i].examination));
  }
  for (SignatureScore& score : e.scores) {
    score.p_value = std::min(1.0, score.p_value * static_cast<double>(results.size()));
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
  e.scores.resize(kinematics.signatures.size());
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
  if (!std::isfinite(e.speed_rpm)) e.speed_rpm = angle->mean_speed_Hz() * 60;

  std::vector<ChannelResult> results(channels.size());
  const Task task{kinematics, *angle, options};
  std::vector<std::vector<QualityNote>> quality =
      record_quality(channels, *angle, kinematics, options.clip_level);
  parallel_for(channels.size(), [&](std::size_t i) {
    results[i] = examine_channel(*channels[i], std::move(quality[i]), task);
  });
  gather(std::move(results), e);
  e.resolvable = e.periods >= fewest_periods;
  if (!e.resolvable) {
    e.quality.push_back({record.source,
                         "too short: " + std::to_string(static_cast<int>(e.periods)) +
                             " whole periods of the gear train, 4 are needed to part its orders",
                         true});
  }
  return e;
}

}  // namespace rvbench::analysis
