#include "analysis/evidence/gear_combs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace rvbench::analysis {
namespace {

constexpr int path_harmonics = 2;  // a path that turns has a mean, a first and a second harmonic

// Multiples of a turn, spread by a path.
struct Comb {
  double turn = 0, path = 0;
};

// One comb is the gear train's period. The others are those of gears, shafts and pins, sound or
// damaged.
std::vector<Comb> combs_of(const Kinematics& kinematics) {
  std::vector<Comb> combs{{1 / kinematics.period_turns, 0}};
  for (const Signature& part : kinematics.signatures) {
    if (part.shows == Shows::as_blows || part.shows == Shows::as_printed) continue;
    combs.push_back({part.order, 0});
    if (part.turn > 0) combs.push_back({part.turn, part.path_order});
  }
  return combs;
}

}  // namespace

std::vector<double> spread(double order, double path_order) {
  std::vector<double> orders{order};
  for (int m = 1; m <= path_harmonics && path_order > 0; ++m) {
    orders.push_back(order - m * path_order);
    orders.push_back(order + m * path_order);
  }
  return orders;
}

bool comb_holds(double turn, double path_order, double order, double near) {
  return std::ranges::any_of(spread(order, path_order), [&](double at) {
    const double multiple = std::round(at / turn);
    return multiple >= 1 && std::abs(at - multiple * turn) < near;
  });
}

std::vector<double> harmonics_of(const GearMesh& mesh, double top_order) {
  std::vector<double> orders;
  for (double h = mesh.order; h <= top_order; h += mesh.order) {
    std::ranges::copy(spread(h, mesh.path_order), std::back_inserter(orders));
  }
  return orders;
}

std::vector<double> sound_lines(const Kinematics& kinematics, double top_order) {
  std::vector<double> lines;
  const auto take = [&](double order, double path) {
    for (const double at : spread(order, path)) {
      if (at > 0 && at <= top_order) lines.push_back(at);
    }
  };
  const auto take_beside = [&](double carrier, double apart, double path) {
    take(carrier - apart, path);
    take(carrier + apart, path);
  };
  for (const GearMesh& mesh : kinematics.meshes) {
    for (double h = mesh.order; h <= top_order + 1; h += mesh.order) {
      take(h, mesh.path_order);
      for (const MeshingGear& gear : mesh.gears) take_beside(h, gear.order, mesh.path_order);
      // Torque that a shaft's turn makes goes through every mesh.
      for (const Signature& part : kinematics.signatures) {
        if (part.shows != Shows::as_turning) continue;
        for (int n = 1; n <= part.forces; ++n) take_beside(h, n * part.order, mesh.path_order);
      }
    }
  }
  for (const Signature& part : kinematics.signatures) {
    if (part.shows != Shows::as_turning) continue;
    for (int h = 1; h <= part.harmonics; ++h) take(h * part.order, 0);
  }
  std::ranges::sort(lines);
  return lines;
}

double distance_from_gears(const Kinematics& kinematics, double order) {
  double nearest = order;
  for (const Comb& comb : combs_of(kinematics)) {
    for (const double at : spread(order, comb.path)) {
      nearest = std::min(nearest, std::abs(at - std::round(at / comb.turn) * comb.turn));
    }
  }
  return nearest;
}

std::vector<bool> locked_lines(const Kinematics& kinematics, double resolution, std::size_t lines,
                               double reach) {
  std::vector<bool> locked(lines, false);
  const double top = static_cast<double>(lines) * resolution;
  const auto mark = [&](double order) {
    const double at = order / resolution;
    for (double line = std::ceil(at - reach); line <= at + reach; ++line) {
      if (line >= 0 && line < static_cast<double>(lines)) {
        locked[static_cast<std::size_t>(line)] = true;
      }
    }
  };
  for (const Comb& comb : combs_of(kinematics)) {
    for (double h = 0; h <= top; h += comb.turn) {
      for (const double order : spread(h, comb.path)) mark(order);
    }
  }
  return locked;
}

}  // namespace rvbench::analysis
