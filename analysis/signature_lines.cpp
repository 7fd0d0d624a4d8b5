#include "analysis/signature_lines.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

/// The harmonic of `s` that lies at `order`; 0 if none does.
int harmonic_at(const Signature& s, double order, double near) {
  const auto h = static_cast<int>(std::lround(order / s.order));
  return h >= s.first_harmonic && h <= s.harmonics && std::abs(h * s.order - order) < near ? h : 0;
}

/// Whether another part has the better claim to the line that is harmonic `h` of signature `mine`.
bool claimed(const std::vector<Signature>& all, std::size_t mine, int h, double near) {
  const double order = h * all[mine].order;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == mine || all[i].slip > 0 || all[i].component == all[mine].component) continue;
    const int other = harmonic_at(all[i], order, near);
    if (other > 0 && (other < h || (other == h && i < mine))) return true;
  }
  return false;
}

bool is_harmonic_of_another(const std::vector<Signature>& all, std::size_t mine, double order,
                            double near) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == mine || all[i].slip > 0) continue;
    if (harmonic_at(all[i], order, near) > 0) return true;
  }
  return false;
}

/// Orders at which two strong mesh lines beat: their first and second harmonics, pair by pair.
std::vector<double> mesh_beats(const Kinematics& kinematics) {
  std::vector<double> beats;
  for (const CharacteristicOrder& a : kinematics.orders) {
    for (const CharacteristicOrder& b : kinematics.orders) {
      if (!a.mesh || !b.mesh || &a == &b) continue;
      for (const int h : {1, 2}) {
        for (const int k : {1, 2}) beats.push_back(std::abs(h * a.order - k * b.order));
      }
    }
  }
  return beats;
}

bool is_among(const std::vector<double>& orders, double order, double near) {
  return std::any_of(orders.begin(), orders.end(),
                     [&](double other) { return std::abs(other - order) < near; });
}

}  // namespace

std::vector<std::vector<double>> signature_lines(const Kinematics& kinematics, double resolution) {
  const std::vector<Signature>& all = kinematics.signatures;
  const double near = 0.75 * resolution;
  const std::vector<double> beats = mesh_beats(kinematics);
  std::vector<std::vector<double>> lines(all.size());
  const auto add = [&](std::size_t i, double order) {
    if (order >= 2 * resolution && !is_among(beats, order, near)) lines[i].push_back(order);
  };
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int h = all[i].first_harmonic; h <= all[i].harmonics; ++h) {
      const double order = h * all[i].order;
      if (all[i].slip == 0 && claimed(all, i, h, near)) continue;
      add(i, order);
      for (const double spacing : all[i].sidebands) {
        for (const double side : {order - spacing, order + spacing}) {
          if (all[i].slip > 0 || !is_harmonic_of_another(all, i, side, near)) add(i, side);
        }
      }
    }
  }
  return lines;
}

}  // namespace rvbench::analysis
