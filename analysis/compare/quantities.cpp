#include "analysis/compare/quantities.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr int harmonics = 3;
constexpr double same_order = 1e-6;

// Of rolling elements; whatever else has a signature is locked to its shaft.
double stray_of(double order, const Kinematics& kinematics) {
  double stray = 0;
  for (const Signature& s : kinematics.signatures) {
    if (std::abs(s.order - order) < same_order) stray = std::max({stray, s.slip, s.tolerance});
  }
  return stray;
}

void add(Quantity line, std::vector<Quantity>& lines) {
  const bool known = std::ranges::any_of(
      lines, [&](const Quantity& l) { return std::abs(l.order - line.order) < same_order; });
  if (!known && line.order > same_order) lines.push_back(std::move(line));
}

// Orders that are one line in a spectrum are one line here, with all of their names.
std::vector<Quantity> characteristic_lines(const Kinematics& kinematics) {
  std::vector<Quantity> lines;
  for (const CharacteristicOrder& o : kinematics.orders) {
    const auto same = std::ranges::find_if(
        lines, [&](const Quantity& l) { return std::abs(l.order - o.order) < same_order; });
    if (same != lines.end()) {
      same->name += ", " + o.name;
    } else {
      lines.push_back({o.name, o.order, stray_of(o.order, kinematics), o.component});
    }
  }
  return lines;
}

bool is_mesh(const Quantity& line, const Kinematics& kinematics) {
  return std::ranges::any_of(kinematics.orders, [&](const CharacteristicOrder& o) {
    return o.mesh && std::abs(o.order - line.order) < same_order;
  });
}

void add_sidebands(const Quantity& mesh, const Quantity& side, std::vector<Quantity>& lines) {
  for (const bool above : {false, true}) {
    const double order = mesh.order + (above ? side.order : -side.order);
    const double stray = order > 0 ? side.stray * side.order / order : 0;
    add({mesh.name + (above ? " + " : " - ") + side.name, order, stray, side.component}, lines);
  }
}

}  // namespace

std::vector<Quantity> quantities_to_compare(const Kinematics& kinematics) {
  const std::vector<Quantity> characteristic = characteristic_lines(kinematics);
  std::vector<Quantity> lines = characteristic;
  for (int h = 2; h <= harmonics; ++h) {
    for (const Quantity& one : characteristic) {
      add({one.name + " x" + std::to_string(h), h * one.order, one.stray, one.component}, lines);
    }
  }
  for (const Quantity& mesh : characteristic) {
    if (!is_mesh(mesh, kinematics)) continue;
    for (const Quantity& side : characteristic) {
      if (!is_mesh(side, kinematics)) add_sidebands(mesh, side, lines);
    }
  }
  std::ranges::stable_sort(lines, {}, &Quantity::order);
  std::vector<Quantity> all = {{"rms"}, {"peak"}, {"crest factor"}, {"kurtosis"}};
  all.insert(all.end(), lines.begin(), lines.end());
  return all;
}

}  // namespace rvbench::analysis
