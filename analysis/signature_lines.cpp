#include "analysis/signature_lines.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// What lies closer than this is the same line.
struct Nearness {
  double near;
  bool same(double a, double b) const { return std::abs(a - b) < near; }
};

// Which harmonic of `s` lies at `order`, from `lowest` on; 0 if none does.
int harmonic_at(const Signature& s, double order, int lowest, Nearness lines) {
  const auto h = static_cast<int>(std::lround(order / s.order));
  return h >= lowest && h <= s.harmonics && lines.same(h * s.order, order) ? h : 0;
}

// The claims of all signatures on the lines of gear-locked parts.
class Claims {
 public:
  Claims(const std::vector<Signature>& signatures, Nearness lines)
      : signatures_(signatures), lines_(lines) {}

  // Whether another part has the better claim to harmonic `h` of signature `mine`.
  bool lost(std::size_t mine, int h) const {
    const double order = h * signatures_[mine].order;
    for (std::size_t i = 0; i < signatures_.size(); ++i) {
      if (!is_rival(mine, i)) continue;
      const int other = harmonic_at(signatures_[i], order, signatures_[i].first_harmonic, lines_);
      if (other > 0 && (other < h || (other == h && i < mine))) return true;
    }
    return false;
  }

  bool is_harmonic_of_another(std::size_t mine, double order) const {
    for (std::size_t i = 0; i < signatures_.size(); ++i) {
      if (i == mine || signatures_[i].shows == Shows::as_blows) continue;
      if (harmonic_at(signatures_[i], order, signatures_[i].first_harmonic, lines_) > 0) {
        return true;
      }
    }
    return false;
  }

  // Neighbours of `order` in the combs of other parts that also have harmonic order `main`.
  std::vector<double> rivals(std::size_t mine, double main, double order) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < signatures_.size(); ++i) {
      const Signature& other = signatures_[i];
      if (!is_rival(mine, i) || harmonic_at(other, main, 2, lines_) == 0) continue;
      for (const double side : {order - other.order, order + other.order}) {
        if (side > other.order / 2) result.push_back(side);
      }
    }
    return result;
  }

 private:
  bool is_rival(std::size_t mine, std::size_t other) const {
    return other != mine && signatures_[other].slip == 0 &&
           signatures_[other].component != signatures_[mine].component;
  }

  const std::vector<Signature>& signatures_;
  Nearness lines_;
};

}  // namespace

std::vector<double> harmonic_lines(const Signature& signature, int harmonic, double stretch) {
  const double main = harmonic * signature.order * stretch;
  std::vector<double> orders{main};
  for (const double spacing : signature.sidebands) {
    orders.push_back(main - spacing);
    orders.push_back(main + spacing);
  }
  return orders;
}

std::vector<std::vector<SignatureLine>> signature_lines(const Kinematics& kinematics,
                                                        double resolution) {
  const std::vector<Signature>& all = kinematics.signatures;
  const Nearness near{0.75 * resolution};
  const Claims claims(all, near);
  std::vector<std::vector<SignatureLine>> lines(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool rolls = all[i].shows == Shows::as_blows;  // its orders are not those of any gear
    for (int h = all[i].first_harmonic; h <= all[i].harmonics; ++h) {
      if (!rolls && claims.lost(i, h)) continue;
      const double main = h * all[i].order;
      int harmonic = -1;
      for (const double order : harmonic_lines(all[i], h)) {
        if (order < 2 * resolution) continue;
        if (order != main && !rolls && claims.is_harmonic_of_another(i, order)) continue;
        // The upper sideband of one harmonic may be the lower one of the next.
        if (std::any_of(lines[i].begin(), lines[i].end(),
                        [&](const SignatureLine& line) { return near.same(line.order, order); })) {
          continue;
        }
        lines[i].push_back(
            {.order = order,
             .sideband_of = harmonic,
             .rivals = rolls ? std::vector<double>{} : claims.rivals(i, main, order)});
        if (order == main) harmonic = static_cast<int>(lines[i].size()) - 1;
      }
    }
  }
  return lines;
}

}  // namespace rvbench::analysis
