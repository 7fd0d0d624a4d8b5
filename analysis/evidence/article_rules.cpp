#include "analysis/evidence/article_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "analysis/evidence/article_reading.hpp"
#include "analysis/evidence/record_resolution.hpp"
#include "analysis/order/resolution.hpp"

namespace rvbench::analysis {
namespace {

constexpr int mesh_harmonics = 3;
constexpr int multiples = 2;

// Where the angle was not measured, orders are as far off as the stated speed.
bool has_line(const Examination& point, double order, double resolution) {
  const double near = near_order(order, resolution, point.angle_measured);
  return std::ranges::any_of(point.channels, [&](const ChannelExamination& channel) {
    return std::ranges::any_of(channel.lines, [&](const SpectralLine& line) {
      return std::abs(line.order - order) <= near;
    });
  });
}

// Around a mesh harmonic, whether or not it is heard: equal planets, or discs half a turn apart,
// cancel it and leave its sidebands.
bool has_sidebands(const Examination& point, double spacing, double resolution,
                   const Kinematics& kinematics) {
  for (const CharacteristicOrder& mesh : kinematics.orders) {
    if (!mesh.mesh) continue;
    for (int h = 1; h <= mesh_harmonics; ++h) {
      for (int k = 1; k <= multiples; ++k) {
        if (has_line(point, h * mesh.order - k * spacing, resolution) ||
            has_line(point, h * mesh.order + k * spacing, resolution)) {
          return true;
        }
      }
    }
  }
  return false;
}

ArticleRule stationary(const std::vector<Examination>& points, const Finding& finding,
                       bool is_local, const Kinematics& kinematics) {
  int judged = 0, with_sidebands = 0, with_rotation = 0;
  for (const Examination& point : points) {
    if (!point.resolvable) continue;
    ++judged;
    const double resolution = record_resolution(point, kinematics);
    with_sidebands += has_sidebands(point, finding.order, resolution, kinematics) ? 1 : 0;
    bool rotation = false;
    for (int k = 1; k <= multiples; ++k) {
      rotation = rotation || has_line(point, k * finding.order, resolution);
    }
    with_rotation += rotation ? 1 : 0;
  }
  const bool lines_are_there = 2 * with_sidebands > judged && 2 * with_rotation > judged;
  const char* conclusion = "";
  if (lines_are_there) {
    conclusion = is_local ? ": both are there, but of blows, and a local fault has them too"
                          : ": profile error, even wear, or faulty design or installation";
  }
  return {"stationary fault?", lines_are_there && !is_local ? "yes" : "no",
          fmt::format("mesh lines carry sidebands at a spacing of order {:.4g} in {} of {} points, "
                      "and the rotation itself or its double is a line in {}{}",
                      finding.order, with_sidebands, judged, with_rotation, conclusion)};
}

const Signature* signature_of(const Finding& finding, const Kinematics& kinematics) {
  const auto found = std::ranges::find_if(kinematics.signatures, [&](const Signature& s) {
    return s.component == finding.component && s.mechanism == finding.mechanism;
  });
  return found == kinematics.signatures.end() ? nullptr : &*found;
}

ArticleRule extent(const Finding& finding, const Kinematics& kinematics) {
  const char* question = "distributed or local?";
  const Signature* signature = signature_of(finding, kinematics);
  if (signature != nullptr && signature->slip > 0) {
    return {question, "cannot tell", "slip smears the higher harmonics of a part that rolls"};
  }
  if (signature == nullptr || signature->harmonics < 3) {
    return {question, "cannot tell", "no harmonic beyond the second is looked at"};
  }
  double total = 0, low = 0;
  for (std::size_t i = 0; i < finding.line_orders.size(); ++i) {
    const double squared = finding.line_depths[i] * finding.line_depths[i];
    total += squared;
    if (finding.line_orders[i] < 2.5 * finding.order) low += squared;
  }
  if (!(total > 0)) return {question, "cannot tell", "no line carries it"};
  const double share = low / total;
  return {question, share > 0.5 ? "distributed" : "local",
          fmt::format("the first two harmonics and what lies around them hold {:.0f} % of what its "
                      "deepest lines do",
                      100 * share)};
}

// The part whose order stands highest in the envelopes, as the article reads them by eye.
std::optional<ArticleRule> alone(const std::vector<Examination>& points,
                                 const Kinematics& kinematics) {
  struct Part {
    std::string component;
    double statistic = 0;
  };
  std::vector<Part> parts;
  double envelopes = 0;
  for (const Signature& signature : kinematics.signatures) parts.push_back({signature.component});
  for (const Examination& point : points) {
    if (point.scores.size() != parts.size()) continue;
    envelopes += article_imfs * static_cast<double>(point.channels.size());
    for (std::size_t s = 0; s < parts.size(); ++s) {
      parts[s].statistic += point.scores[s].article_statistic;
    }
  }
  if (envelopes == 0) return {};
  std::ranges::stable_sort(parts, std::ranges::greater{}, &Part::statistic);
  // A line of noise has -ln p = 1 with a scatter of 1.
  const double by_noise = 3 * std::sqrt(envelopes);
  std::string why;
  for (std::size_t i = 0; i < std::min<std::size_t>(3, parts.size()); ++i) {
    why += fmt::format("{}{} {:.0f}", why.empty() ? "-ln p above noise's: " : ", ",
                       parts[i].component, parts[i].statistic);
  }
  const bool stands_out = parts.front().statistic > by_noise;
  return ArticleRule{"which part, by the envelopes of IMF 1 to 5 alone?",
                     stands_out ? parts.front().component : "none",
                     why + fmt::format("; noise has up to {:.0f}", by_noise)};
}

const Finding* hypothesis_of(const Diagnosis& diagnosis, const char* component) {
  const std::vector<const Finding*> all = diagnosis.hypotheses();
  const auto found = std::ranges::find(all, component, &Finding::component);
  return found == all.end() ? nullptr : *found;
}

std::string depth_text(const Finding& f) {
  const std::string depth = f.points.empty() ? fmt::format("below {:.3f}", f.severity_high)
                                             : fmt::format("{:.3f}", f.severity);
  return fmt::format("order {:.4g}: depth {}, limit {:.3f}", f.order, depth, f.limit);
}

std::optional<ArticleRule> shaft_or_sun(const Diagnosis& diagnosis) {
  const std::string& first = diagnosis.findings.front().component;
  if (first != "input_shaft" && first != "sun_gear") return {};
  const Finding* shaft = hypothesis_of(diagnosis, "input_shaft");
  const Finding* sun = hypothesis_of(diagnosis, "sun_gear");
  if (shaft == nullptr || sun == nullptr) return {};
  const auto is_found = [&](const Finding* f) {
    return std::ranges::any_of(diagnosis.findings,
                               [&](const Finding& found) { return &found == f; });
  };
  const char* answer = "both";
  if (!is_found(sun)) answer = "input shaft";
  if (!is_found(shaft)) answer = "sun gear";
  return ArticleRule{"input-shaft misalignment or sun profile error?", answer,
                     depth_text(*shaft) + "; " + depth_text(*sun)};
}

}  // namespace

std::vector<ArticleRule> article_rules(const std::vector<Examination>& points,
                                       const Diagnosis& diagnosis, const Kinematics& kinematics) {
  std::vector<ArticleRule> rules;
  if (auto rule = alone(points, kinematics)) rules.push_back(std::move(*rule));
  if (diagnosis.findings.empty()) return rules;
  const Finding& first = diagnosis.findings.front();
  ArticleRule how_far = extent(first, kinematics);
  if (std::ranges::any_of(kinematics.orders, &CharacteristicOrder::mesh)) {
    rules.push_back(stationary(points, first, how_far.answer == "local", kinematics));
  }
  rules.push_back(std::move(how_far));
  if (auto rule = shaft_or_sun(diagnosis)) rules.push_back(std::move(*rule));
  return rules;
}

}  // namespace rvbench::analysis
