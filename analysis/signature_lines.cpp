#include "analysis/signature_lines.hpp"

#include <cmath>

namespace rvbench::analysis {
namespace {

/// The harmonic of `s` that lies at `order`; 0 if none does.
int harmonic_at(const Signature& s, double order, double near) {
  const auto h = static_cast<int>(std::lround(order / s.order));
  return h >= 1 && h <= s.harmonics && std::abs(h * s.order - order) < near ? h : 0;
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

}  // namespace

std::vector<std::vector<double>> signature_lines(const Kinematics& kinematics, double resolution) {
  const std::vector<Signature>& all = kinematics.signatures;
  const double near = 0.75 * resolution;
  std::vector<std::vector<double>> lines(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (int h = 1; h <= all[i].harmonics; ++h) {
      const double order = h * all[i].order;
      if (all[i].slip > 0 || !claimed(all, i, h, near)) lines[i].push_back(order);
      for (const double spacing : all[i].sidebands) {
        for (const double side : {order - spacing, order + spacing}) {
          if (side < 2 * resolution) continue;
          if (all[i].slip > 0 || !is_harmonic_of_another(all, i, side, near)) {
            lines[i].push_back(side);
          }
        }
      }
    }
  }
  return lines;
}

}  // namespace rvbench::analysis
