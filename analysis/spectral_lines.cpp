#include "analysis/spectral_lines.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/line_floor.hpp"
#include "analysis/spectrum.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr int most_harmonics = 12;
constexpr int most_sidebands = 3;
constexpr double same_family = 1e-3;  // relative: what one line of an estimate may be off
constexpr double speed_error = 3e-4;  // relative: what a stated mean speed may be off

bool same(double a, double b, double near) { return std::abs(a - b) <= near; }

std::string times(const std::string& name, int harmonic) {
  return harmonic == 1 ? name : name + " x" + std::to_string(harmonic);
}

}  // namespace

std::string meaning_of(double order, double near, const Kinematics& kinematics) {
  for (const CharacteristicOrder& o : kinematics.orders) {
    const auto h = static_cast<int>(std::lround(order / o.order));
    if (h >= 1 && h <= most_harmonics && same(order, h * o.order, near)) {
      return times(o.name, h);
    }
  }
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
  // Whatever repeats with the gear train's period is made by the gear train.
  const double turns = kinematics.period_turns;
  const double multiple = std::round(order * turns);
  if (turns > 1 && same(order * turns, multiple, near * turns)) {
    return "gear train, " + std::to_string(std::lround(multiple)) + "/" +
           std::to_string(std::lround(turns));
  }
  return {};
}

std::vector<SpectralLine> spectral_lines(const Channel& x, const ShaftAngle& angle,
                                         const Kinematics& kinematics, std::size_t most) {
  const double speed_Hz = angle.mean_speed_Hz();
  int per_turn = 32;
  while (per_turn < 8192 && per_turn * speed_Hz < x.rate_Hz) per_turn *= 2;
  const Eigen::VectorXd over_angle =
      angle.resample(x.samples, x.rate_Hz, x.start_s, kinematics.period_turns, per_turn);
  if (over_angle.size() < 64) return {};
  const Eigen::VectorXd swing = over_angle.array() - over_angle.mean();
  const Spectrum spectrum = amplitude_spectrum(swing, per_turn, Window::hann);
  const auto locked =
      static_cast<Eigen::Index>(std::lround(1 / (spectrum.resolution * kinematics.period_turns)));
  const LineFloor floor = line_floor(spectrum, locked);

  const auto last =
      std::min(spectrum.amplitude.size() - 2,
               static_cast<Eigen::Index>(0.4 * x.rate_Hz / speed_Hz / spectrum.resolution));
  const double alpha = 1e-3 / static_cast<double>(std::max<Eigen::Index>(last, 1));
  std::vector<SpectralLine> lines;
  for (Eigen::Index i = 2; i < last; ++i) {
    const double here = spectrum.amplitude[i];
    if (here < spectrum.amplitude[i - 1] || here <= spectrum.amplitude[i + 1]) continue;
    const double p = line_p_value(floor.power[i] / floor.floor[i], 1, floor.floor_lines);
    if (p > alpha) continue;
    const double order = spectrum.axis(i);
    lines.push_back(
        {order, order * speed_Hz, here, p, meaning_of(order, spectrum.resolution, kinematics)});
  }
  std::sort(lines.begin(), lines.end(),
            [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; });
  if (lines.size() > most) lines.resize(most);
  return lines;
}

std::vector<SpectralLine> families(std::vector<SpectralLine> unexplained) {
  std::vector<SpectralLine> result;
  while (!unexplained.empty()) {
    // The fundamental with the most members; of equals the strongest, as the list is sorted.
    std::size_t best = 0;
    std::vector<std::size_t> best_members;
    for (std::size_t f = 0; f < unexplained.size(); ++f) {
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < unexplained.size(); ++i) {
        const double h = std::round(unexplained[i].order / unexplained[f].order);
        if (h >= 1 && h <= most_harmonics &&
            same(unexplained[i].order, h * unexplained[f].order,
                 same_family * unexplained[i].order)) {
          members.push_back(i);
        }
      }
      if (members.size() > best_members.size()) {
        best = f;
        best_members = std::move(members);
      }
    }
    SpectralLine family = unexplained[best];
    std::vector<int> harmonics;
    for (const std::size_t i : best_members) {
      harmonics.push_back(static_cast<int>(std::lround(unexplained[i].order / family.order)));
      family.amplitude = std::max(family.amplitude, unexplained[i].amplitude);
    }
    std::sort(harmonics.begin(), harmonics.end());
    if (harmonics.size() > 1) {
      family.meaning = "harmonics";
      for (const int h : harmonics) family.meaning += " " + std::to_string(h);
    }
    result.push_back(family);
    for (auto i = best_members.rbegin(); i != best_members.rend(); ++i) {
      unexplained.erase(unexplained.begin() + static_cast<std::ptrdiff_t>(*i));
    }
  }
  std::sort(result.begin(), result.end(),
            [](const SpectralLine& a, const SpectralLine& b) { return a.amplitude > b.amplitude; });
  return result;
}

}  // namespace rvbench::analysis
