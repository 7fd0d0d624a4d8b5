#include "analysis/evidence/related_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "analysis/evidence/growth_law.hpp"
#include "analysis/evidence/kinship.hpp"

namespace rvbench::analysis {
namespace {

std::string name_of(const Signature& s) {
  return fmt::format("{}: {} at order {:.4g}", s.component, s.mechanism, s.order);
}

// Severity over its limit, less what its growth speaks against it: at most nine tenths, as the
// ranges are rules of thumb. Finite where the limit allows nothing at all.
double weight_of(const Finding& finding) {
  const double odds = std::max(odds_at_most(finding.growth_p_value), 0.1);
  return odds * finding.severity / std::max(finding.limit, 1e-6);
}

bool is_graver(const ShownPart& a, const ShownPart& b) { return a.weight > b.weight; }

// A bad sun loads its shaft unevenly; a bent shaft gives no tooth lines. So where both are bad the
// sun comes first, unless the shaft is far worse.
void put_causes_first(std::vector<ShownPart>& shown, const Kinematics& kinematics) {
  constexpr double far_worse = 3;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const ShownPart& shaft = shown[i];
    if (kinematics.signatures[shaft.signature].shows != Shows::as_turning) continue;
    const auto here = shown.begin() + static_cast<std::ptrdiff_t>(i);
    const auto cause = std::find_if(here + 1, shown.end(), [&](const ShownPart& other) {
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
void join_twins(std::vector<ShownPart>& shown, const Kinematics& kinematics) {
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
    std::erase_if(shown, [&](const ShownPart& other) {
      return std::ranges::count(twins, other.signature) > 0;
    });
  }
}

// A bad rolling element shows once per turn of the cage, as a worn cage does. If slip has spread
// its own lines, only the cage's is left, and the element is the likelier cause.
void share_cages(std::vector<ShownPart>& shown, const Kinematics& kinematics,
                 std::vector<Finding>& not_shown) {
  for (const RollingBearing& bearing : kinematics.bearings) {
    const auto of = [&](std::size_t part) {
      return std::ranges::find(shown, part, &ShownPart::signature);
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
    cage->weight = weight_of(finding);
    std::erase_if(not_shown, [&](const Finding& other) {
      return other.component == ball.component && other.mechanism == ball.mechanism;
    });
  }
}

// Blows of a bad bearing slip, and meet lines of gears by chance: where they sound, a gear that is
// hardly to be seen is not shown.
void drop_doubtful(std::vector<ShownPart>& shown, const Kinematics& kinematics,
                   std::vector<Finding>& not_shown) {
  constexpr double plainly = 5;  // times what would just be seen
  const auto rolls = [&](const ShownPart& s) {
    return kinematics.signatures[s.signature].shows == Shows::as_blows;
  };
  const bool is_struck =
      std::ranges::any_of(shown, [&](const ShownPart& s) { return rolls(s) && s.is_bad(); });
  if (!is_struck) return;
  const auto doubtful = std::stable_partition(shown.begin(), shown.end(), [&](const ShownPart& s) {
    return rolls(s) || !(s.finding.severity < plainly * s.finding.smallest_visible);
  });
  for (auto s = doubtful; s != shown.end(); ++s) {
    clear_shown(s->finding);
    not_shown.push_back(std::move(s->finding));
  }
  shown.erase(doubtful, shown.end());
}

// A wandering speed spreads the lines of a bad gear over those of the other gears and shafts in its
// mesh, and blows that slip meet lines of gears by chance. A part that shows far less than that
// gear or bearing may show only this.
bool is_spread_by(const ShownPart& lesser, const ShownPart& graver, const Kinematics& kinematics) {
  constexpr double far_worse = 4;
  const bool by_slip = kinematics.signatures[graver.signature].shows == Shows::as_blows &&
                       kinematics.signatures[lesser.signature].shows != Shows::as_blows;
  return (by_slip || share_a_mesh(lesser.signature, graver.signature, kinematics)) &&
         far_worse * lesser.finding.severity < graver.finding.severity;
}

// Names the gravest of those before it that it may follow from.
void mark_consequences(std::vector<ShownPart>& shown, const Kinematics& kinematics) {
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

}  // namespace

ShownPart shown_part(std::size_t signature, Finding finding) {
  const double weight = weight_of(finding);
  return {signature, std::move(finding), weight};
}

void clear_shown(Finding& finding) {
  finding.points.clear();
  finding.severity = finding.severity_low = 0;
}

void relate_parts(std::vector<ShownPart>& shown, std::vector<Finding>& not_shown,
                  const Kinematics& kinematics) {
  std::ranges::stable_sort(shown, is_graver);
  put_causes_first(shown, kinematics);
  drop_doubtful(shown, kinematics, not_shown);
  join_twins(shown, kinematics);
  share_cages(shown, kinematics, not_shown);
  mark_consequences(shown, kinematics);
}

}  // namespace rvbench::analysis
