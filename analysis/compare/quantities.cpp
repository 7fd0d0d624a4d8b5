#include "analysis/compare/quantities.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/order/same_order.hpp"

namespace rvbench::analysis {
namespace {

constexpr int harmonics = 3;

// Of rolling elements; whatever else has a signature is locked to its shaft.
double stray_of(double order, const Kinematics& kinematics) {
  double stray = 0;
  for (const Signature& s : kinematics.signatures) {
    if (std::abs(s.order - order) < same_order) stray = std::max({stray, s.slip, s.tolerance});
  }
  return stray;
}

bool is_at(const Quantity& line, double order) { return std::abs(line.order - order) < same_order; }

// @return the line of that order, added or there before; nullptr if there is no such order
Quantity* add(Quantity line, std::vector<Quantity>& lines) {
  const auto known =
      std::ranges::find_if(lines, [&](const Quantity& l) { return is_at(l, line.order); });
  if (known != lines.end()) return &*known;
  if (!(line.order > same_order)) return nullptr;
  return &lines.emplace_back(std::move(line));
}

// Orders that are one line in a spectrum are one line here, with all of their names.
std::vector<Quantity> characteristic_lines(const Kinematics& kinematics) {
  std::vector<Quantity> lines;
  for (const CharacteristicOrder& o : kinematics.orders) {
    const auto same =
        std::ranges::find_if(lines, [&](const Quantity& l) { return is_at(l, o.order); });
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
    return o.mesh && is_at(line, o.order);
  });
}

void add_sidebands(const Quantity& mesh, const Quantity& side, std::vector<Quantity>& lines) {
  for (const bool above : {false, true}) {
    const double order = mesh.order + (above ? side.order : -side.order);
    add({mesh.name + (above ? " + " : " - ") + side.name, order, 0, side.component}, lines);
  }
}

// "carrier", or the order itself where it has no name.
std::string name_at(double order, const std::vector<Quantity>& characteristic) {
  const auto named =
      std::ranges::find_if(characteristic, [&](const Quantity& l) { return is_at(l, order); });
  return named == characteristic.end() ? fmt::format("{:.4g}", order) : named->name;
}

std::string spoken(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

// Harmonics of a signature, each with its sidebands.
void add_family(std::size_t index, const Signature& s, const std::vector<Quantity>& characteristic,
                std::vector<Quantity>& lines) {
  const auto add_member = [&](const std::string& name, double order, double stray) {
    Quantity* line = add({name, order, stray, s.component}, lines);
    if (line != nullptr) line->families.push_back(index);
  };
  const double stray = std::max(s.slip, s.tolerance);
  for (int h = s.first_harmonic; h <= s.harmonics; ++h) {
    const std::string name = spoken(s.component) + (h > 1 ? fmt::format(" x{}", h) : "");
    add_member(name, h * s.order, stray);
    for (const double spacing : s.sidebands) {
      const std::string side = name_at(spacing, characteristic);
      add_member(name + " - " + side, h * s.order - spacing, stray);
      add_member(name + " + " + side, h * s.order + spacing, stray);
    }
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
      if (side.stray == 0 && !is_mesh(side, kinematics)) add_sidebands(mesh, side, lines);
    }
  }
  for (std::size_t i = 0; i < kinematics.signatures.size(); ++i) {
    add_family(i, kinematics.signatures[i], characteristic, lines);
  }
  std::ranges::stable_sort(lines, {}, &Quantity::order);
  std::vector<Quantity> all = {{"rms"}, {"peak"}, {"crest factor"}, {"kurtosis"}};
  all.insert(all.end(), lines.begin(), lines.end());
  return all;
}

}  // namespace rvbench::analysis
