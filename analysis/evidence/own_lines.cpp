#include "analysis/evidence/own_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "analysis/evidence/gear_combs.hpp"
#include "analysis/evidence/kinship.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest_own = 12;  // lines that make a comb of its own
// What a tooth does lasts about as long as its contact, so that further harmonics of its mesh carry
// more noise than damage.
constexpr double mesh_harmonics = 4;

// The nearest multiple of a part's turn, spread by its path.
double nearest_of(const Signature& part, double order) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const double at : spread(order, part.path_order)) {
    const double line = order - (at - std::round(at / part.turn) * part.turn);
    if (std::abs(line - order) < std::abs(nearest - order)) nearest = line;
  }
  return nearest;
}

class PartCombs {
 public:
  PartCombs(const Kinematics& kinematics, double apart, double wander, double top_order)
      : k_(kinematics),
        apart_(apart),
        wander_(wander),
        top_(top_order),
        sound_(sound_lines(k_, top_)) {
    for (const GearMesh& mesh : k_.meshes) {
      std::ranges::copy(harmonics_of(mesh, top_), std::back_inserter(carriers_));
    }
    std::ranges::sort(carriers_);
  }

  PartLines of(const Signature& part) const {
    PartLines lines;
    if (part.shows == Shows::as_blows || part.shows == Shows::as_printed) return lines;
    take_meshes(part, lines);
    // A force at a shaft's order is bad only against the meshes beside it.
    if (k_.meshes.empty()) return lines;
    if (part.shows == Shows::as_teeth) {
      take_teeth(part, lines);
      if (part.strikes) take_turn_lines(part, lines);
    } else {
      lines.own = of_turning(part);
    }
    for (OwnLine& line : lines.own) line.carriers = carriers_near(line.order);
    return lines;
  }

 private:
  // Of the part's meshes; of all where it strikes, or is in none.
  void take_meshes(const Signature& part, PartLines& lines) const {
    const bool in_one = !part.strikes && is_in_a_mesh(part);
    for (const GearMesh& mesh : k_.meshes) {
      if (in_one && !is_gear_of(mesh, part.turn)) continue;
      lines.contact_order =
          lines.contact_order > 0 ? std::min(lines.contact_order, mesh.order) : mesh.order;
      for (const double order : harmonics_of(mesh, top_)) add(order, lines.mesh);
    }
  }

  bool is_in_a_mesh(const Signature& part) const {
    return std::ranges::any_of(k_.meshes,
                               [&](const GearMesh& mesh) { return is_gear_of(mesh, part.turn); });
  }

  // A gear may mesh faster than the slowest mesh, at which `own` ends: its blows are as short as
  // its own contact.
  void take_turn_lines(const Signature& part, PartLines& lines) const {
    double fastest = lines.contact_order;
    for (const GearMesh& mesh : k_.meshes) {
      if (is_gear_of(mesh, part.turn)) fastest = std::max(fastest, mesh.order);
    }
    const double highest = std::min(top_, mesh_harmonics * fastest);
    for (int h = 1; h * part.turn <= highest; ++h) {
      const double order = h * part.turn;
      if (is_free(order) && !is_held_by_another(part, order)) lines.turn_lines.push_back(h);
    }
  }

  void take_teeth(const Signature& part, PartLines& lines) const {
    std::vector<OwnLine> alone, shared;
    std::vector<double> seen;
    const double highest =
        lines.contact_order > 0 ? std::min(top_, mesh_harmonics * lines.contact_order) : top_;
    for (int h = 1; h * part.turn <= highest; ++h) {
      for (const double order : spread(h * part.turn, part.path_order)) {
        if (!add(order, seen) || !is_free(order)) continue;
        OwnLine line{order, rivals(part, order), {}, h};
        (is_held_by_another(part, order) ? shared : alone).push_back(std::move(line));
      }
    }
    lines.own = std::move(alone);
    if (lines.own.size() < fewest_own) {
      std::erase_if(shared, [](const OwnLine& line) { return line.rivals.empty(); });
      lines.own.insert(lines.own.end(), shared.begin(), shared.end());
    }
    if (!seen.empty()) {
      lines.share = part.beside_mesh * static_cast<double>(lines.own.size()) /
                    static_cast<double>(seen.size());
    }
  }

  std::vector<OwnLine> of_turning(const Signature& part) const {
    std::vector<OwnLine> own;
    std::vector<double> seen;
    const auto take = [&](OwnLine line) {
      if (!add(line.order, seen)) return;
      line.rivals = rivals(part, line.order);
      own.push_back(std::move(line));
    };
    for (int h = 1; h <= part.forces; ++h) take({.order = h * part.order, .is_force = true});
    for (const GearMesh& mesh : k_.meshes) {
      if (!(part.turn > 0) || !is_gear_of(mesh, part.turn)) continue;
      for (double h = mesh.order; h + part.turn <= top_; h += mesh.order) {
        // Planets cancel most carriers: there one may stand alone.
        const double carrier = mesh.path_order > 0 ? 0 : h;
        for (const double side : {h - part.turn, h + part.turn}) {
          for (const double order : spread(side, mesh.path_order)) {
            if (!is_mesh_line(order, mesh)) take({.order = order, .carrier = carrier});
          }
        }
      }
    }
    return own;
  }

  // The lines beside that only the other parts' combs hold.
  std::vector<double> rivals(const Signature& part, double order) const {
    constexpr double a_line_of_its_own = 0.4;  // of apart_: beyond a Hann line's main lobe
    std::vector<double> beside;
    for (const Signature& other : k_.signatures) {
      if (&other == &part || other.shows != Shows::as_teeth) continue;
      if (!comb_holds(other.turn, other.path_order, order, apart_)) continue;
      const double theirs = nearest_of(other, order);
      if (std::abs(theirs - order) > a_line_of_its_own * apart_) beside.push_back(theirs);
      for (const int turns : {-2, -1, 1, 2}) {
        const double at = theirs + turns * other.turn;
        const bool is_own =
            part.shows == Shows::as_teeth && comb_holds(part.turn, part.path_order, at, apart_);
        if (at < other.turn / 2 || at > top_ || is_own || !is_free(at)) continue;
        beside.push_back(at);
      }
    }
    return beside;
  }

  bool is_held_by_another(const Signature& part, double order) const {
    return std::ranges::any_of(k_.signatures, [&](const Signature& other) {
      return other.shows == Shows::as_teeth && !turn_alike(part, other) &&
             comb_holds(other.turn, other.path_order, order, apart_);
    });
  }

  // A line of another mesh than the part's, or of the same at another harmonic.
  bool is_mesh_line(double order, const GearMesh& own) const {
    return std::ranges::any_of(k_.meshes, [&](const GearMesh& mesh) {
      return (&mesh == &own ? comb_holds(mesh.order, mesh.path_order, order, apart_)
                            : is_modulated_line(order, mesh));
    });
  }

  bool is_modulated_line(double order, const GearMesh& mesh) const {
    if (comb_holds(mesh.order, mesh.path_order, order, apart_)) return true;
    return std::ranges::any_of(mesh.gears, [&](const MeshingGear& gear) {
      return comb_holds(mesh.order, mesh.path_order, order - gear.order, apart_) ||
             comb_holds(mesh.order, mesh.path_order, order + gear.order, apart_);
    });
  }

  std::vector<double> carriers_near(double order) const {
    std::vector<double> near;
    auto next = std::ranges::lower_bound(carriers_, order - wander_);
    for (; next != carriers_.end() && *next <= order + wander_; ++next) {
      if (std::abs(*next - order) >= apart_) near.push_back(*next);
    }
    return near;
  }

  // No line of a sound machine.
  bool is_free(double order) const {
    const auto next = std::ranges::lower_bound(sound_, order - apart_);
    return next == sound_.end() || *next >= order + apart_;
  }

  bool add(double order, std::vector<double>& lines) const {
    if (order < apart_ || order > top_) return false;
    const auto near = [&](double line) { return std::abs(line - order) < apart_; };
    // Orders come nearly ascending: a line that is there already is among the last.
    const auto last = lines.size() > 64 ? lines.end() - 64 : lines.begin();
    if (std::any_of(last, lines.end(), near)) return false;
    lines.push_back(order);
    return true;
  }

  const Kinematics& k_;
  double apart_;
  double wander_;
  double top_;
  std::vector<double> sound_;
  std::vector<double> carriers_;
};

}  // namespace

std::vector<PartLines> own_lines(const Kinematics& kinematics, double apart, double wander,
                                 double top_order) {
  const PartCombs lines(kinematics, apart, wander, top_order);
  std::vector<PartLines> all;
  for (const Signature& part : kinematics.signatures) all.push_back(lines.of(part));
  return all;
}

}  // namespace rvbench::analysis
