#include "analysis/spectral_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "analysis/line_floor.hpp"
#include "analysis/order/resolution.hpp"
#include "analysis/order/standing_lines.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis {
namespace {

constexpr int most_harmonics = 12;
constexpr int most_sidebands = 3;
constexpr int most_slipping = 3;      // harmonics of what slips
constexpr double same_family = 5e-4;  // relative: what one line of an estimate may be off

bool same(double a, double b, double near) { return std::abs(a - b) <= near; }

std::string times(const std::string& name, int harmonic) {
  return harmonic == 1 ? name : name + " x" + std::to_string(harmonic);
}

bool stronger(const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; }

// A line among those that no kinematics explains, and what it is in its family: a harmonic of the
// fundamental, or its sideband of a mesh.
struct Membership {
  std::size_t line;
  const CharacteristicOrder* mesh;
  int multiple;  // of the fundamental; away from the mesh, negative below it
};

std::string role_of(const Membership& member) {
  if (member.mesh == nullptr) return fmt::format("x{}", member.multiple);
  return fmt::format("{} {} {}x", member.mesh->name, member.multiple < 0 ? "-" : "+",
                     std::abs(member.multiple));
}

std::optional<Membership> member_of(double fundamental, std::size_t line, double order,
                                    const Kinematics& kinematics) {
  const double near = same_family * order;
  const auto harmonic = static_cast<int>(std::lround(order / fundamental));
  if (harmonic >= 1 && harmonic <= most_harmonics && same(order, harmonic * fundamental, near)) {
    return Membership{line, nullptr, harmonic};
  }
  for (const CharacteristicOrder& mesh : kinematics.orders) {
    if (!mesh.mesh || fundamental > mesh.order / 2) continue;
    const double away = order - mesh.order;
    const auto k = static_cast<int>(std::lround(away / fundamental));
    if (k != 0 && std::abs(k) <= most_sidebands && same(away, k * fundamental, near)) {
      return Membership{line, &mesh, k};
    }
  }
  return std::nullopt;
}

std::vector<Membership> members_of(double fundamental, const std::vector<SpectralLine>& lines,
                                   const Kinematics& kinematics) {
  std::vector<Membership> members;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (const auto member = member_of(fundamental, i, lines[i].order, kinematics)) {
      members.push_back(*member);
    }
  }
  return members;
}

// A family as one line: the fundamental's order, the strongest amplitude, the roles seen.
SpectralLine gathered(const std::vector<SpectralLine>& lines, std::size_t fundamental,
                      const std::vector<Membership>& members) {
  SpectralLine family = lines[fundamental];
  std::vector<std::pair<double, std::string>> roles;
  for (const Membership& member : members) {
    family.amplitude = std::max(family.amplitude, lines[member.line].amplitude);
    roles.emplace_back(lines[member.line].order, role_of(member));
    (member.mesh == nullptr ? family.harmonics : family.sidebands) += 1;
  }
  std::sort(roles.begin(), roles.end());
  if (roles.size() < 2) return family;
  for (const auto& [order, role] : roles) {
    family.meaning += (family.meaning.empty() ? "" : ", ") + role;
  }
  return family;
}

}  // namespace

bool slips(double order, const Kinematics& kinematics) {
  return std::ranges::any_of(kinematics.signatures, [&](const Signature& s) {
    return s.slip > 0 && std::abs(order - s.order) <= s.slip * s.order;
  });
}

bool is_characteristic(const SpectralLine& line, const Kinematics& kinematics) {
  return std::ranges::any_of(kinematics.orders,
                             [&](const CharacteristicOrder& o) { return o.name == line.meaning; });
}

std::string meaning_of(double order, double near, const Kinematics& kinematics) {
  // The lowest harmonic says most: nine teeth of a sun make its ninth harmonic the mesh.
  const CharacteristicOrder* part = nullptr;
  int lowest = most_harmonics + 1;
  for (const CharacteristicOrder& o : kinematics.orders) {
    const auto h = static_cast<int>(std::lround(order / o.order));
    if (h >= 1 && h < lowest && same(order, h * o.order, near)) {
      part = &o;
      lowest = h;
    }
  }
  if (part != nullptr) return times(part->name, lowest);
  for (const CharacteristicOrder& mesh : kinematics.orders) {
    if (!mesh.mesh) continue;
    const double nearest = std::max(1.0, std::round(order / mesh.order));
    for (const CharacteristicOrder& side : kinematics.orders) {
      if (side.mesh || side.order < 2 * near) continue;
      const double away = order - nearest * mesh.order;
      const auto k = static_cast<int>(std::lround(std::abs(away) / side.order));
      if (k >= 1 && k <= most_sidebands && nearest <= most_harmonics &&
          same(std::abs(away), k * side.order, near)) {
        return times(mesh.name, static_cast<int>(nearest)) + (away < 0 ? " - " : " + ") +
               (k == 1 ? "" : std::to_string(k) + " ") + side.name;
      }
    }
  }
  // Whatever repeats with the gear train's period is made by the gear train, unless orders are so
  // uncertain that half of all lines would.
  const double turns = kinematics.period_turns;
  const double multiple = std::round(order * turns);
  if (turns > 1 && near * turns < 0.25 && same(order * turns, multiple, near * turns)) {
    return "gear train, " + std::to_string(std::lround(multiple)) + "/" +
           std::to_string(std::lround(turns));
  }
  return {};
}

std::string may_be(double order, const Kinematics& kinematics) {
  for (const Signature& s : kinematics.signatures) {
    const auto h = static_cast<int>(std::lround(order / s.order));
    if (h < 1 || h > most_slipping) continue;
    if (s.slip == 0 || !same(order, h * s.order, s.slip * h * s.order)) continue;
    const auto named = std::ranges::find_if(kinematics.orders, [&](const CharacteristicOrder& o) {
      return o.component == s.component && o.order == s.order;
    });
    return "may be " + times(named == kinematics.orders.end() ? s.component : named->name, h);
  }
  return {};
}

std::vector<SpectralLine> spectral_lines(const Channel& x, const ShaftAngle& angle,
                                         const Kinematics& kinematics, std::size_t most) {
  return spectral_lines(OrderLines(x, angle, kinematics.period_turns), kinematics, most);
}

std::vector<SpectralLine> spectral_lines(const OrderLines& x, const Kinematics& kinematics,
                                         std::size_t most) {
  if (x.samples() < 64) return {};
  Spectrum spectrum = x.spectrum();
  spectrum.amplitude[0] = 0;  // the mean is no line, and no floor of any
  const auto locked =
      static_cast<Eigen::Index>(std::lround(1 / (spectrum.resolution * kinematics.period_turns)));
  const LineFloor floor = line_floor(spectrum, locked);

  const auto last = std::min(spectrum.amplitude.size() - 2,
                             static_cast<Eigen::Index>(x.top_order() / spectrum.resolution));
  const double alpha = 1e-3 / static_cast<double>(std::max<Eigen::Index>(last, 1));
  std::vector<SpectralLine> lines;
  for (const StandingLine& line : standing_lines(spectrum, floor, last, alpha)) {
    const double order = line.place * spectrum.resolution;
    const double near = near_order(order, spectrum.resolution, x.angle_is_measured());
    std::string meaning = meaning_of(order, near, kinematics);
    if (meaning.empty()) meaning = may_be(order, kinematics);
    lines.push_back(
        {order, order * x.mean_speed_Hz(), line.amplitude, line.p_value, std::move(meaning)});
  }
  const auto rest = lines.begin() + static_cast<std::ptrdiff_t>(std::min(most, lines.size()));
  lines.erase(std::remove_if(
                  rest, lines.end(),
                  [&](const SpectralLine& line) { return !is_characteristic(line, kinematics); }),
              lines.end());
  return lines;
}

std::vector<SpectralLine> families(std::vector<SpectralLine> unexplained,
                                   const Kinematics& kinematics) {
  std::vector<SpectralLine> result;
  while (!unexplained.empty()) {
    // The fundamental with the most members; of equals the strongest, as the list is sorted.
    std::size_t best = 0;
    std::vector<Membership> best_members;
    for (std::size_t f = 0; f < unexplained.size(); ++f) {
      std::vector<Membership> members = members_of(unexplained[f].order, unexplained, kinematics);
      if (members.size() > best_members.size()) {
        best = f;
        best_members = std::move(members);
      }
    }
    result.push_back(gathered(unexplained, best, best_members));
    for (auto m = best_members.rbegin(); m != best_members.rend(); ++m) {
      unexplained.erase(unexplained.begin() + static_cast<std::ptrdiff_t>(m->line));
    }
  }
  std::ranges::sort(result, stronger);
  return result;
}

}  // namespace rvbench::analysis
