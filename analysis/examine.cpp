#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/rolling_evidence.hpp"
#include "analysis/examine_channel.hpp"
#include "analysis/indicators/hysteresis_record.hpp"
#include "analysis/indicators/shaft_indicators.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/quality.hpp"
#include "analysis/quality/record_quality.hpp"
#include "analysis/quality/same_samples.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/speed_by_lines.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr double fewest_periods = lines_to_part;  // to part lines one period's order apart

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

// Channels that nothing forbids to judge by.
std::vector<const Channel*> sound_among(const std::vector<const Channel*>& channels,
                                        const std::vector<std::vector<QualityNote>>& quality) {
  std::vector<const Channel*> sound;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!is_spoiled(quality[i])) sound.push_back(channels[i]);
  }
  return sound;
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

// Only the evidence of channels that are alike can be added. The channels of one kind count, and
// this is one of them: kinds that are long enough come first, then the kind of most channels, then
// the longest. It is null where no channel can be read.
const ChannelResult* first_counted(const std::vector<ChannelResult>& results) {
  const auto rank = [&](const ChannelResult& result) {
    const auto channels = std::ranges::count_if(results, [&](const ChannelResult& other) {
      return alike(other, result) && !other.repeats_another;
    });
    return std::tuple(result.periods >= fewest_periods, channels, result.periods);
  };
  const ChannelResult* best = nullptr;
  for (const ChannelResult& result : results) {
    if (!result.gears.empty() && (best == nullptr || rank(result) > rank(*best))) best = &result;
  }
  return best;
}

void score(std::vector<ChannelResult>& results, const Kinematics& kinematics, Examination& e) {
  const ChannelResult* first = first_counted(results);
  if (first == nullptr) return;
  e.periods = first->periods;
  std::vector<std::vector<GearReading>> gears;
  std::vector<std::vector<GearReading>> noise;
  std::vector<ResidualEnvelope> residuals;
  std::vector<const ChannelResult*> counted;
  const std::size_t noise_parts = first->noise.size();
  for (ChannelResult& result : results) {
    const bool counts = alike(result, *first) && !result.repeats_another;
    if (!counts && !result.repeats_another && !is_spoiled(result.quality)) {
      result.quality.push_back(
          {result.examination.name,
           "of another length or rate than the channels that are judged by: not weighed", false});
    }
    if (counts) counted.push_back(&result);
    gears.push_back(counts ? std::move(result.gears) : std::vector<GearReading>{});
    noise.push_back(counts && result.noise.size() == noise_parts ? std::move(result.noise)
                                                                 : std::vector<GearReading>{});
    residuals.push_back(counts ? std::move(result.residual) : ResidualEnvelope{});
  }
  score_gears(gears, first->places->gears, e.scores);
  e.unknown = score_rolling(residuals, kinematics, e.scores);
  // Blows swing what is left with their shaft, and with all that carries it.
  const bool is_struck = std::ranges::any_of(e.scores, [&](const SignatureScore& score) {
    return kinematics.signatures[static_cast<std::size_t>(score.signature)].shows ==
               Shows::as_blows &&
           score.p_value < significant_p;
  });
  const bool has_family = std::ranges::any_of(e.unknown, [](const UnknownFamily& family) {
    return family.harmonics >= harmonics_of_damage;
  });
  const bool is_quiet = !is_struck && !has_family;
  if (noise_parts > 0 && is_quiet) score_noise(noise, first->places->noise, kinematics, e.scores);
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
  if (!told->is_measured()) {
    by_lines = corrected_by_lines(sound_among(channels, quality), *told, kinematics);
  }
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
