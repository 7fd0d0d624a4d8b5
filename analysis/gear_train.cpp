#include "analysis/gear_train.hpp"

#include <stdexcept>

#include "analysis/bearing_signatures.hpp"

namespace rvbench::analysis {
namespace {

void check(const GearTrain& t) {
  if (t.shafts.empty()) throw std::invalid_argument("gear_train: needs at least one shaft");
  const auto exists = [&t](int shaft) {
    return shaft >= 0 && shaft < static_cast<int>(t.shafts.size());
  };
  for (const GearTrain::Mesh& m : t.meshes) {
    const bool driven_known = m.driven >= 0;
    if (!exists(m.driver) || (driven_known && !exists(m.driven))) {
      throw std::invalid_argument("gear_train: mesh " + m.name + ": no such shaft");
    }
    if (m.driver_teeth < 1 || (driven_known && m.driven_teeth < 1)) {
      throw std::invalid_argument("gear_train: mesh " + m.name + ": teeth must be positive");
    }
  }
  for (const GearTrain::Bearing& b : t.bearings) {
    if (!exists(b.shaft)) {
      throw std::invalid_argument("gear_train: bearing " + b.name + ": no such shaft");
    }
  }
}

Signature shaft_signature(const GearTrain::Shaft& shaft, double order) {
  return {.component = shaft.component,
          .mechanism = "misalignment",
          .table4_item = "",
          .order = order,
          .harmonics = 2,
          .sidebands = {},
          .shows = Shows::as_turning,
          .turn = order,
          .depth_limit = 0.25,
          .limit_why = "assumed: runout and pitch errors of sound wheels swing a mesh by a quarter",
          .advice = "check balance, run-out and alignment of the " + shaft.name};
}

Signature gear_signature(const std::string& component, double order) {
  return {.component = component,
          .mechanism = "tooth_damage",
          .table4_item = "",
          .order = order,
          .harmonics = 12,
          .sidebands = {},
          .shows = Shows::as_teeth,
          .strikes = true,
          .turn = order,
          .depth_limit = 0.075,
          .aligned_limit = 0.01,  // no sound tooth strikes: it is as much as noise hides
          .limit_why = "assumed: one tooth among many may not stand out by more than its share",
          .advice = "look at the teeth of the " + component};
}

GearMesh mesh_of(const GearTrain::Mesh& m, const GearTrain& train,
                 const std::vector<double>& orders) {
  const auto gear = [&](int shaft, int teeth) {
    const auto index = static_cast<std::size_t>(shaft);
    return MeshingGear{train.shafts[index].name, orders[index], teeth};
  };
  GearMesh mesh{m.name, m.driver_teeth * orders[static_cast<std::size_t>(m.driver)], {}};
  mesh.gears.push_back(gear(m.driver, m.driver_teeth));
  if (m.driven >= 0) mesh.gears.push_back(gear(m.driven, m.driven_teeth));
  return mesh;
}

}  // namespace

std::vector<double> shaft_orders(const GearTrain& train) {
  check(train);
  std::vector<double> orders(train.shafts.size(), 0.0);
  orders[0] = 1;
  for (std::size_t pass = 0; pass < train.meshes.size(); ++pass) {
    for (const GearTrain::Mesh& m : train.meshes) {
      const double driver = orders[static_cast<std::size_t>(m.driver)];
      if (m.driven >= 0 && driver > 0 && orders[static_cast<std::size_t>(m.driven)] == 0) {
        orders[static_cast<std::size_t>(m.driven)] = driver * m.driver_teeth / m.driven_teeth;
      }
    }
  }
  return orders;
}

Kinematics gear_train(const GearTrain& train) {
  const std::vector<double> orders = shaft_orders(train);
  Kinematics k;
  k.machine = train.machine;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    if (orders[i] == 0) {
      throw std::invalid_argument("gear_train: no mesh leads to shaft " + train.shafts[i].name);
    }
    k.orders.push_back({train.shafts[i].name, orders[i], {}, train.shafts[i].component, ""});
    k.signatures.push_back(shaft_signature(train.shafts[i], orders[i]));
  }
  for (const GearTrain::Mesh& m : train.meshes) {
    const double driver = orders[static_cast<std::size_t>(m.driver)];
    k.orders.push_back({m.name, m.driver_teeth * driver, {}, m.driver_component, "", true});
    k.meshes.push_back(mesh_of(m, train, orders));
    k.signatures.push_back(gear_signature(m.driver_component, driver));
    if (m.driven >= 0) {
      k.signatures.push_back(
          gear_signature(m.driven_component, orders[static_cast<std::size_t>(m.driven)]));
    }
  }
  for (const GearTrain::Bearing& b : train.bearings) {
    const double shaft = orders[static_cast<std::size_t>(b.shaft)];
    k.bearings.push_back(rolling_bearing(b.name, b.geometry, shaft, k.signatures.size()));
    for (Signature& s : bearing_signatures(b.geometry, shaft, b.slip)) {
      const std::string name = b.name + " " + s.component;
      if (train.bearings.size() > 1) s.component = name;  // whose inner race?
      if (train.meshes.empty()) {
        s.depth_limit = 0.65;
        s.limit_why = "assumed: blows of a sound bearing carry less than a fifth of the power";
      }
      k.orders.push_back({name, s.order, {}, s.component, ""});
      k.signatures.push_back(std::move(s));
    }
  }
  return k;
}

}  // namespace rvbench::analysis
