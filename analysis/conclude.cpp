#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/growth_law.hpp"
#include "analysis/evidence/kinship.hpp"
#include "analysis/evidence/lines_by_depth.hpp"
#include "analysis/evidence/severity.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/statistics.hpp"
#include "analysis/unexplained_families.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t lines_listed = 8;  // evidence lines shown per finding
constexpr double fits_at = 0.05;         // p of a growth that contradicts its mechanism below it

// Damage is about the same share of a mesh at every speed. A tone that stands still in Hz meets a
// part's lines at one: what a record shows far above all that records of other speeds, two at
// least, show or may hide.
bool is_tone(const SignatureScore& shown, const Examination& point,
             const std::vector<const Examination*>& read) {
  constexpr double far_above = 10, same_speed = 0.02;
  int others = 0;
  for (const Examination* other : read) {
    if (std::abs(other->speed_rpm / point.speed_rpm - 1) < same_speed) continue;
    const SignatureScore& there = other->scores[static_cast<std::size_t>(shown.signature)];
    const bool is_far_below =
        far_above * there.depth < shown.depth && far_above * there.smallest_visible < shown.depth;
    if (!is_far_below) return false;
    ++others;
  }
  return others >= 2;
}

// Points that speak for a signature, and how.
struct Evidence {
  std::vector<const Examination*> shown_by;
  std::vector<const SignatureScore*> scores;  // of shown_by
  std::vector<const SignatureScore*> all;     // of all resolvable points that could read it

  // Half of what was measured speaks for a bad part, or more than one record shows it even if all
  // that were looked at, for all parts, are paid for: at high load, say. One record of many is
  // none.
  bool shows(double tests) const {
    if (2 * scores.size() >= all.size()) return !scores.empty();
    return std::ranges::count_if(scores, [&](const SignatureScore* score) {
             return score->p_value < paid(tests);
           }) > 1;
  }

  // Deepest in a record that shows it all the same; 0 if none does.
  double surely_shown(double tests) const {
    double depth = 0;
    for (const SignatureScore* score : scores) {
      if (score->p_value < paid(tests)) depth = std::max(depth, score->depth);
    }
    return depth;
  }

  double paid(double tests) const {
    return significant_p / (tests * static_cast<double>(all.size()));
  }

  // Index of the point that shows it deepest.
  std::size_t deepest() const {
    const auto depth = [](const SignatureScore* score) { return score->depth; };
    return static_cast<std::size_t>(std::ranges::max_element(scores, {}, depth) - scores.begin());
  }
};

Evidence gather(const std::vector<Examination>& points, std::size_t signature) {
  Evidence evidence;
  // Also where its median channel has no more than noise: else only depths that noise raised count.
  const auto shows = [](const SignatureScore& score) { return score.p_value < plausible_p; };
  std::vector<const Examination*> read;
  std::size_t by_noise = 0;
  for (const Examination& point : points) {
    const SignatureScore& score = point.scores[signature];
    if (!point.resolvable || !score.is_read()) continue;
    read.push_back(&point);
    evidence.all.push_back(&score);
    by_noise += shows(score) && score.by_noise ? 1 : 0;
  }
  // Noise that swings at a few points only is no damage: a tone passes a resonance there.
  const bool noise_counts = 2 * by_noise >= evidence.all.size();
  for (std::size_t i = 0; i < read.size(); ++i) {
    const SignatureScore& score = *evidence.all[i];
    if (!shows(score) || (score.by_noise && !noise_counts)) continue;
    if (is_tone(score, *read[i], read)) continue;
    evidence.shown_by.push_back(read[i]);
    evidence.scores.push_back(&score);
  }
  return evidence;
}

void list_lines(const Evidence& evidence, Finding& finding) {
  const SignatureScore& deepest = *evidence.scores[evidence.deepest()];
  for (const std::size_t i : lines_by_depth(deepest)) {
    if (finding.line_orders.size() == lines_listed || deepest.line_depths[i] == 0) break;
    finding.line_orders.push_back(deepest.line_orders[i]);
    finding.line_depths.push_back(deepest.line_depths[i]);
  }
}

// NaN where a channel's unit is not known, or the part shows in the noise alone.
double amplitude_m_s2(const Evidence& evidence) {
  std::vector<double> amplitudes;
  for (std::size_t i = 0; i < evidence.scores.size(); ++i) {
    const std::vector<ChannelExamination>& channels = evidence.shown_by[i]->channels;
    const bool is_si = std::ranges::all_of(
        channels, [](const ChannelExamination& channel) { return channel.unit == "m/s²"; });
    const double amplitude = evidence.scores[i]->amplitude;
    if (is_si && !std::isnan(amplitude)) amplitudes.push_back(amplitude);
  }
  return amplitudes.empty() ? not_known : median(std::move(amplitudes));
}

std::string name_of(const Signature& s) {
  return fmt::format("{}: {} at order {:.4g}", s.component, s.mechanism, s.order);
}

// A part must show in half of the points, so this is the least severity that half of them would
// have shown. NaN where no point could read a line of the part.
double smallest_visible(const std::vector<const SignatureScore*>& scores) {
  std::vector<double> visible;
  for (const SignatureScore* score : scores) {
    if (!std::isnan(score->smallest_visible)) visible.push_back(score->smallest_visible);
  }
  if (visible.empty()) return not_known;
  const auto middle = visible.begin() + (std::ssize(visible) - 1) / 2;
  std::ranges::nth_element(visible, middle);
  return *middle;
}

// The hypothesis as far as it goes whether or not a point shows it.
Finding weigh(const Signature& signature, const Evidence& evidence, double tests) {
  Finding f;
  f.component = signature.component;
  f.mechanism = signature.mechanism;
  f.table4_item = signature.table4_item;
  f.order = signature.order;
  const bool by_noise =
      !evidence.scores.empty() && std::ranges::all_of(evidence.scores, &SignatureScore::by_noise);
  f.limit =
      by_noise ? std::min(signature.depth_limit, signature.noise_limit) : signature.depth_limit;
  f.advice = signature.advice;
  std::vector<double> p_values;
  for (const SignatureScore* score : evidence.all) {
    p_values.push_back(score->p_value);
    f.log_likelihood_ratio += score->log_likelihood_ratio;
  }
  f.p_value = std::min(1.0, combined_p_value(p_values) * tests);
  for (const Examination* point : evidence.shown_by) f.points.push_back(point->source);
  f.smallest_visible = smallest_visible(evidence.all);
  Severity severity{0, 0, f.smallest_visible};
  if (!evidence.scores.empty()) severity = severity_of(evidence.scores);
  if (severity.depth == 0) {
    f.points.clear();  // what they show is no deeper than their noise
    severity.high = f.smallest_visible;
  }
  f.severity = severity.depth;
  f.severity_low = severity.low;
  f.severity_high = severity.high;
  f.over_sound = (f.severity - signature.sound_median) / signature.sound_scatter;
  return f;
}

// No point counts as one that shows it.
void clear_shown(Finding& f) {
  f.points.clear();
  f.severity = f.severity_low = 0;
}

// Adds where and how the points show it.
void describe(Finding& f, const Evidence& evidence, const Kinematics& kinematics,
              std::size_t signature) {
  f.order = evidence.scores.front()->order;
  f.frequency_Hz = f.order * units::Hz_from_rpm(std::abs(evidence.shown_by.front()->speed_rpm));
  for (const SignatureScore* score : evidence.scores) {
    if (std::find(f.imfs.begin(), f.imfs.end(), score->imf) == f.imfs.end()) {
      f.imfs.push_back(score->imf);
    }
  }
  std::sort(f.imfs.begin(), f.imfs.end());
  f.severity_m_s2 = amplitude_m_s2(evidence);
  list_lines(evidence, f);
  f.growth = growth_law(evidence.shown_by, signature);
  f.growth_p_value = p_value_of_growth(f.growth.load, kinematics.signatures[signature].load_growth);
  f.growth_fits = f.growth_p_value >= fits_at;
}

// Severity over its limit, less what its growth speaks against it: at most nine tenths, as the
// ranges are rules of thumb. Finite where the limit allows nothing at all.
double weight(const Finding& finding) {
  const double odds = std::max(odds_at_most(finding.growth_p_value), 0.1);
  return odds * finding.severity / std::max(finding.limit, 1e-6);
}

// A hypothesis that shows.
struct Shown {
  std::size_t signature;
  Finding finding;
  Evidence evidence;
  double weight;

  bool is_bad() const { return finding.severity > finding.limit; }
};

bool is_graver(const Shown& a, const Shown& b) { return a.weight > b.weight; }

// A bad sun loads its shaft unevenly; a bent shaft gives no tooth lines. So where both are bad the
// sun comes first, unless the shaft is far worse.
void put_causes_first(std::vector<Shown>& shown, const Kinematics& kinematics) {
  constexpr double far_worse = 3;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const Shown& shaft = shown[i];
    if (kinematics.signatures[shaft.signature].shows != Shows::as_turning) continue;
    const auto here = shown.begin() + static_cast<std::ptrdiff_t>(i);
    const auto cause = std::find_if(here + 1, shown.end(), [&](const Shown& other) {
      return other.is_bad() && far_worse * other.finding.severity > shaft.finding.severity &&
             may_follow_from(shaft.signature, other.signature, kinematics);
    });
    if (cause == shown.end()) continue;
    cause->weight = std::max(cause->weight, shaft.weight);
    std::rotate(here, cause, cause + 1);
  }
}

// Parts whose lines are the same are one finding, by the name of the graver one.
// At most two are named; what else it may be stands in cannot_tell_from.
void join_twins(std::vector<Shown>& shown, const Kinematics& kinematics) {
  for (std::size_t i = 0; i < shown.size(); ++i) {
    Finding& first = shown[i].finding;
    const Signature& own = kinematics.signatures[shown[i].signature];
    std::vector<std::size_t> twins;
    for (std::size_t j = i + 1; j < shown.size(); ++j) {
      if (have_the_same_lines(own, kinematics.signatures[shown[j].signature])) {
        twins.push_back(shown[j].signature);
      }
    }
    // Planets may cancel what the other one makes, so it need not show.
    for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
      const bool is_new = s != shown[i].signature && std::ranges::count(twins, s) == 0;
      if (is_new && planets_hide(own, kinematics.signatures[s])) twins.push_back(s);
    }
    if (twins.empty()) continue;
    first.one_of = {first.component, kinematics.signatures[twins.front()].component};
    for (const std::size_t twin : twins) {
      first.cannot_tell_from.push_back(name_of(kinematics.signatures[twin]));
    }
    std::erase_if(
        shown, [&](const Shown& other) { return std::ranges::count(twins, other.signature) > 0; });
  }
}

// A bad rolling element shows once per turn of the cage, as a worn cage does. If slip has spread
// its own lines, only the cage's is left, and the element is the likelier cause.
void share_cages(std::vector<Shown>& shown, const Kinematics& kinematics, Diagnosis& d) {
  for (const RollingBearing& bearing : kinematics.bearings) {
    const auto of = [&](std::size_t part) {
      return std::ranges::find(shown, part, &Shown::signature);
    };
    const auto cage = of(bearing.cage_wear);
    if (cage == shown.end() || of(bearing.ball) != shown.end()) continue;
    const Signature& ball = kinematics.signatures[bearing.ball];
    Finding& finding = cage->finding;
    finding.one_of = {ball.component, finding.component};
    finding.cannot_tell_from = {name_of(kinematics.signatures[bearing.cage_wear])};
    finding.component = ball.component;
    finding.mechanism = ball.mechanism;
    finding.limit = ball.depth_limit;
    cage->weight = weight(finding);
    std::erase_if(d.not_shown, [&](const Finding& other) {
      return other.component == ball.component && other.mechanism == ball.mechanism;
    });
  }
}

// Blows of a bad bearing slip, and meet lines of gears by chance: where they sound, a gear that is
// hardly to be seen is not shown.
void drop_doubtful(std::vector<Shown>& shown, const Kinematics& kinematics, Diagnosis& d) {
  constexpr double plainly = 5;  // times what would just be seen
  const auto rolls = [&](const Shown& s) {
    return kinematics.signatures[s.signature].shows == Shows::as_blows;
  };
  const bool is_struck =
      std::ranges::any_of(shown, [&](const Shown& s) { return rolls(s) && s.is_bad(); });
  if (!is_struck) return;
  const auto doubtful = std::stable_partition(shown.begin(), shown.end(), [&](const Shown& s) {
    return rolls(s) || !(s.finding.severity < plainly * s.finding.smallest_visible);
  });
  for (auto s = doubtful; s != shown.end(); ++s) {
    clear_shown(s->finding);
    d.not_shown.push_back(std::move(s->finding));
  }
  shown.erase(doubtful, shown.end());
}

// A wandering speed spreads the lines of a bad gear over those of the other gears and shafts in its
// mesh, and blows that slip meet lines of gears by chance. A part that shows far less than that
// gear or bearing may show only this.
bool is_spread_by(const Shown& lesser, const Shown& graver, const Kinematics& kinematics) {
  constexpr double far_worse = 4;
  const bool by_slip = kinematics.signatures[graver.signature].shows == Shows::as_blows &&
                       kinematics.signatures[lesser.signature].shows != Shows::as_blows;
  return (by_slip || share_a_mesh(lesser.signature, graver.signature, kinematics)) &&
         far_worse * lesser.finding.severity < graver.finding.severity;
}

// Names the gravest of those before it that it may follow from.
void relate(std::vector<Shown>& shown, const Kinematics& kinematics) {
  for (std::size_t i = 1; i < shown.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (!may_follow_from(shown[i].signature, shown[j].signature, kinematics) &&
          !is_spread_by(shown[i], shown[j], kinematics)) {
        continue;
      }
      const Finding& graver = shown[j].finding;
      shown[i].finding.may_follow_from = graver.component + ": " + graver.mechanism;
      break;
    }
  }
}

// A family that most of the points show, at one order but for slip.
std::vector<UnknownFamily> unknown_of(const std::vector<Examination>& points) {
  constexpr double slip = 0.03;
  std::vector<UnknownFamily> families;
  std::size_t resolvable = 0;
  for (const Examination& point : points) {
    resolvable += point.resolvable ? 1 : 0;
    for (const UnknownFamily& found : point.unknown) {
      const auto same = std::ranges::find_if(families, [&](const UnknownFamily& family) {
        return std::abs(family.spacing - found.spacing) < slip * family.spacing;
      });
      UnknownFamily& family = same == families.end() ? families.emplace_back(found) : *same;
      family.points.push_back(point.source);
      family.severity = std::max(family.severity, found.severity);
      family.p_value = std::min(family.p_value, found.p_value);
    }
  }
  std::erase_if(families,
                [&](const UnknownFamily& family) { return 2 * family.points.size() < resolvable; });
  return families;
}

// Lines of the signal itself that modulate a mesh and have many harmonics, which no single tone, no
// mains and no inverter does. A family at a multiple of a known part's order is that part's.
bool is_damage_like(const SpectralLine& family, const Diagnosis& d, const Kinematics& kinematics) {
  constexpr int fewest_harmonics = 4, fewest_sidebands = 2;
  constexpr double same = 2e-3;  // relative
  const bool is_known = std::ranges::any_of(kinematics.orders, [&](const CharacteristicOrder& o) {
    return is_multiple(family.order, o.order, same);
  });
  // Blows that slip are the bearing's that was found.
  constexpr double jitter = 0.01;
  const auto hypotheses = d.hypotheses();
  const bool is_found = std::ranges::any_of(hypotheses, [&](const Finding* f) {
    return !f->points.empty() && is_multiple(family.order, f->order, jitter);
  });
  return !is_known && !is_found && family.harmonics >= fewest_harmonics &&
         family.sidebands >= fewest_sidebands;
}

UnknownFamily unknown_family(const SpectralLine& family, const std::vector<Examination>& points) {
  UnknownFamily unknown{.spacing = family.order,
                        .harmonics = family.harmonics,
                        .sidebands = family.sidebands,
                        .p_value = family.p_value};
  for (const Examination& point : points) unknown.points.push_back(point.source);
  return unknown;
}

}  // namespace

bool Finding::may_be(const std::string& part) const {
  return component == part || std::ranges::find(one_of, part) != one_of.end();
}

std::vector<const Finding*> Diagnosis::hypotheses() const {
  std::vector<const Finding*> all;
  for (const auto* list : {&findings, &below_limit, &not_shown}) {
    for (const Finding& hypothesis : *list) all.push_back(&hypothesis);
  }
  return all;
}

const Finding* Diagnosis::second() const {
  if (findings.empty()) return nullptr;
  for (const Finding* hypothesis : hypotheses()) {
    if (hypothesis->component != findings.front().component) return hypothesis;
  }
  return nullptr;
}

Diagnosis conclude(const std::vector<Examination>& points, const Kinematics& kinematics) {
  Diagnosis d;
  for (const Examination& point : points) {
    d.resolvable = d.resolvable || point.resolvable;
    d.quality.insert(d.quality.end(), point.quality.begin(), point.quality.end());
  }
  std::vector<Shown> shown;
  const auto tests = static_cast<double>(kinematics.signatures.size());
  for (std::size_t s = 0; s < kinematics.signatures.size(); ++s) {
    Evidence evidence = gather(points, s);
    Finding f = weigh(kinematics.signatures[s], evidence, tests);
    if (!evidence.shows(tests) || f.p_value >= significant_p || f.severity == 0) {
      // Too few points show the part. They do not prove that it is within its limit.
      clear_shown(f);
      f.severity_high = std::max(f.smallest_visible, evidence.surely_shown(tests));
      d.not_shown.push_back(std::move(f));
      continue;
    }
    describe(f, evidence, kinematics, s);
    const double own = weight(f);
    shown.push_back({s, std::move(f), std::move(evidence), own});
  }
  std::ranges::stable_sort(shown, is_graver);
  put_causes_first(shown, kinematics);
  drop_doubtful(shown, kinematics, d);
  join_twins(shown, kinematics);
  share_cages(shown, kinematics, d);
  relate(shown, kinematics);
  double total = 0;
  for (const Shown& s : shown) total += s.is_bad() ? s.weight : 0;
  for (Shown& s : shown) {
    const bool is_bad = s.is_bad();
    if (is_bad) s.finding.confidence = s.weight / total;
    (is_bad ? d.findings : d.below_limit).push_back(std::move(s.finding));
  }
  std::ranges::sort(d.not_shown, {}, &Finding::p_value);
  d.unknown = unknown_of(points);
  d.unexplained = unexplained_families(points, kinematics);
  for (const SpectralLine& family : d.unexplained) {
    if (is_damage_like(family, d, kinematics)) d.unknown.push_back(unknown_family(family, points));
  }
  return d;
}

}  // namespace rvbench::analysis
