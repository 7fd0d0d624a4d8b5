#include "bench/kinematics_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include "analysis/gear_train.hpp"
#include "analysis/planetary_stage.hpp"
#include "analysis/rv_reducer.hpp"
#include "bench/file_kind.hpp"
#include "bench/kinematics_files.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr hal::Bounds teeth{1, 10000};
constexpr hal::Bounds length_mm{1e-3, 1e5};

// Nothing if no shipped one is called that.
const EmbeddedFile* shipped(const std::string& name) {
  const auto found = std::ranges::find(kinematics_files(), name, &EmbeddedFile::name);
  return found == kinematics_files().end() ? nullptr : &*found;
}

hal::ConfigReader open(const std::string& name_or_path) {
  const EmbeddedFile* file = shipped(name_or_path);
  return file != nullptr ? hal::ConfigReader::from_text(file->text, file->name + ".json")
                         : hal::ConfigReader::from_file(name_or_path);
}

// Whether so many circles lie on a larger one without touching: balls in a bearing, planets round a
// sun.
bool have_room(int count, double diameter, double pitch_diameter) {
  constexpr double rounding = 1.001;
  return count < 2 || diameter <= rounding * pitch_diameter * std::sin(std::numbers::pi / count);
}

class Doubts {
 public:
  void doubt_bearing(const std::string& at, const analysis::BearingGeometry& bearing) {
    if (have_room(bearing.rolling_elements, bearing.ball_diameter_mm, bearing.pitch_diameter_mm)) {
      return;
    }
    list.push_back({0, at, "its rolling elements have no room beside each other"});
  }

  // The teeth of one planet reach an addendum, half a tooth's share of its diameter, towards the
  // next.
  void doubt_planets(const std::string& at, int planets, int sun_teeth, int planet_teeth) {
    if (have_room(planets, planet_teeth + 1, sun_teeth + planet_teeth)) return;
    list.push_back({0, at, "the planets have no room round the sun beside each other"});
  }

  std::vector<hal::ConfigFault> list;
};

constexpr hal::Bounds race_orders{0.1, 1000};

// Makers state a bearing by its size, or by what its races do per turn.
void read_sizes(hal::ConfigReader& b, analysis::BearingGeometry& geometry) {
  geometry.rolling_elements = b.integer("rolling_elements", {2, 1000});
  geometry.ball_diameter_mm = b.number("ball_diameter_mm", length_mm);
  geometry.pitch_diameter_mm = b.number("pitch_diameter_mm", length_mm);
  if (geometry.ball_diameter_mm >= geometry.pitch_diameter_mm) {
    b.fault("ball_diameter_mm", "must be below pitch_diameter_mm");
  }
}

// A rolling element passes either the one race or the other.
constexpr double whole_within = 0.02;

void read_races(hal::ConfigReader& b, analysis::BearingGeometry& geometry) {
  const std::size_t faults_before = b.faults().size();
  const double outer = b.number("outer_race_order", race_orders);
  const double inner = b.number("inner_race_order", race_orders);
  if (b.faults().size() > faults_before) return;
  const double sum = outer + inner;
  if (std::abs(sum - std::round(sum)) > whole_within) {
    b.fault("inner_race_order",
            fmt::format("adds up to {:.4g} with outer_race_order, must be a whole number, "
                        "of rolling elements",
                        sum));
  } else if (inner <= outer) {
    b.fault("inner_race_order", "must be above outer_race_order");
  } else {
    geometry = analysis::bearing_of_races(outer, inner, geometry.contact_angle_deg);
    if (geometry.ball_diameter_mm >= geometry.pitch_diameter_mm) {
      b.fault("contact_angle_deg", "is too large for these races");
    }
  }
}

// @param fixed  the race that stands where the file does not say so
analysis::BearingGeometry read_bearing(hal::ConfigReader& b, const char* fixed = "outer") {
  analysis::BearingGeometry geometry;
  geometry.contact_angle_deg = b.number("contact_angle_deg", {0, 89}, 0);
  if (b.has("outer_race_order") || b.has("inner_race_order")) {
    read_races(b, geometry);
  } else {
    read_sizes(b, geometry);
  }
  geometry.inner_stands =
      (b.has("fixed_race") ? b.choice("fixed_race", {"inner", "outer"}) : fixed) == "inner";
  b.text("assumption", "");
  return geometry;
}

double read_rated_Nm(hal::ConfigReader& reducer) {
  constexpr const char* key = "rated_output_torque_Nm";
  return reducer.has(key) ? reducer.number(key, {0.1, 100000}) : not_known;
}

analysis::Kinematics read_rv_reducer(const std::string& machine, hal::ConfigReader& root,
                                     Doubts& doubts) {
  hal::ConfigReader rv = root.object("rv_reducer");
  const analysis::RvGeometry geometry{.sun_teeth = rv.integer("sun_teeth", teeth),
                                      .planet_teeth = rv.integer("planet_teeth", teeth),
                                      .planets = rv.integer("planets", {1, 12}, 2),
                                      .lobes = rv.integer("lobes", teeth),
                                      .pins = rv.integer("pins", teeth)};
  const bool both_stated = rv.has("lobes") && rv.has("pins");
  if (both_stated && geometry.pins != geometry.lobes + 1) {
    rv.fault("pins", "must be one more than lobes (" + std::to_string(geometry.lobes) + ")");
  }
  analysis::BearingGeometry bearing;
  if (auto b = rv.optional_object("crank_bearing")) bearing = read_bearing(*b);
  const double rated_Nm = read_rated_Nm(rv);
  root.finish();
  if (!root.faults().empty()) return {};
  doubts.doubt_bearing("/rv_reducer/crank_bearing", bearing);
  doubts.doubt_planets("/rv_reducer/planets", geometry.planets, geometry.sun_teeth,
                       geometry.planet_teeth);
  analysis::Kinematics kinematics = analysis::rv_reducer(machine, geometry, bearing);
  kinematics.rated_output_torque_Nm = rated_Nm;
  return kinematics;
}

analysis::Kinematics read_planetary(const std::string& machine, hal::ConfigReader& root,
                                    Doubts& doubts) {
  const std::size_t faults_before = root.faults().size();
  hal::ConfigReader stage = root.object("planetary");
  const analysis::PlanetaryGeometry geometry{.sun_teeth = stage.integer("sun_teeth", teeth),
                                             .planet_teeth = stage.integer("planet_teeth", teeth),
                                             .ring_teeth = stage.integer("ring_teeth", teeth),
                                             .planets = stage.integer("planets", {1, 12})};
  const int fitting = geometry.sun_teeth + 2 * geometry.planet_teeth;
  const bool are_stated = root.faults().size() == faults_before;
  if (are_stated && std::abs(geometry.ring_teeth - fitting) > analysis::most_shifted_teeth) {
    stage.fault("ring_teeth", fmt::format("must be about sun_teeth + 2 planet_teeth, {}", fitting));
  }
  analysis::BearingGeometry bearing;
  if (auto b = stage.optional_object("planet_bearing")) bearing = read_bearing(*b, "inner");
  const double rated_Nm = read_rated_Nm(stage);
  root.finish();
  if (!root.faults().empty()) return {};
  doubts.doubt_bearing("/planetary/planet_bearing", bearing);
  doubts.doubt_planets("/planetary/planets", geometry.planets, geometry.sun_teeth,
                       geometry.planet_teeth);
  analysis::Kinematics kinematics = analysis::planetary_stage(machine, geometry, bearing);
  kinematics.rated_output_torque_Nm = rated_Nm;
  return kinematics;
}

// Names of one kind of part: findings, limits and other parts point at a part by its name, so no
// two may have the same.
class Names {
 public:
  explicit Names(const char* kind) : kind_(kind) {}
  void add(hal::ConfigReader& at, const char* key, const std::string& name) {
    if (name.empty()) return;  // a fault already
    if (!index_.emplace(name, static_cast<int>(index_.size())).second) {
      at.fault(key, "there is already a " + kind_ + " \"" + name + "\"");
    }
  }
  // The place in the list of the part that `key` names; a name that is not there is a fault.
  int find(hal::ConfigReader& at, const char* key) const {
    const std::string name = at.text(key);
    const auto found = index_.find(name);
    if (found != index_.end()) return found->second;
    at.fault(key, "no " + kind_ + " is called \"" + name + "\"");
    return 0;
  }

 private:
  std::string kind_;
  std::map<std::string, int> index_;
};

// What findings call gears. An idler is the same gear in two meshes.
class Gears {
 public:
  void add(hal::ConfigReader& at, const char* key, const std::string& component, int shaft,
           int count) {
    const auto [known, is_new] = gears_.try_emplace(component, shaft, count);
    if (!is_new && known->second != std::pair(shaft, count)) {
      at.fault(key, "there is already a gear \"" + component + "\", of other teeth or shaft");
    }
  }

 private:
  std::map<std::string, std::pair<int, int>> gears_;
};

analysis::GearTrain::Mesh read_mesh(hal::ConfigReader& m, const Names& shafts, Gears& gears) {
  analysis::GearTrain::Mesh mesh;
  mesh.name = m.text("name");
  mesh.driver = shafts.find(m, "driver");
  mesh.driver_teeth = m.integer("driver_teeth", teeth);
  mesh.driver_component = m.text("driver_component", mesh.name + " driver");
  gears.add(m, "driver_component", mesh.driver_component, mesh.driver, mesh.driver_teeth);
  if (m.has("driven")) {
    mesh.driven = shafts.find(m, "driven");
    mesh.driven_teeth = m.integer("driven_teeth", teeth);
    mesh.driven_component = m.text("driven_component", mesh.name + " driven");
    gears.add(m, "driven_component", mesh.driven_component, mesh.driven, mesh.driven_teeth);
  }
  return mesh;
}

analysis::Kinematics read_gear_train(const std::string& machine, hal::ConfigReader& root,
                                     Doubts& doubts) {
  analysis::GearTrain train;
  train.machine = machine;
  Names shafts("shaft"), shaft_components("shaft of component"), meshes("mesh"),
      bearings("bearing");
  for (hal::ConfigReader& s : root.objects("shafts")) {
    const std::string name = s.text("name");
    shafts.add(s, "name", name);
    train.shafts.push_back({name, s.text("component", name)});
    if (s.has("component")) shaft_components.add(s, "component", train.shafts.back().component);
  }
  Gears gears;
  for (hal::ConfigReader& m : root.objects("meshes", false)) {
    train.meshes.push_back(read_mesh(m, shafts, gears));
    meshes.add(m, "name", train.meshes.back().name);
  }
  for (hal::ConfigReader& b : root.objects("bearings", false)) {
    analysis::GearTrain::Bearing bearing;
    bearing.name = b.text("name");
    bearings.add(b, "name", bearing.name);
    bearing.shaft = shafts.find(b, "shaft");
    bearing.slip = b.number("slip", {0, 0.1}, bearing.slip);
    bearing.geometry = read_bearing(b);
    doubts.doubt_bearing(fmt::format("/bearings/{}", train.bearings.size()), bearing.geometry);
    train.bearings.push_back(std::move(bearing));
  }
  if (train.shafts.empty() && root.faults().empty())
    root.fault("shafts", "needs at least one shaft: the input");
  root.finish();
  if (!root.faults().empty()) return {};
  const std::vector<double> orders = analysis::shaft_orders(train);
  for (std::size_t i = 0; i < orders.size(); ++i) {
    if (orders[i] == 0) root.fault("shafts", "no mesh leads to " + train.shafts[i].name);
  }
  for (const analysis::GearTrain::Mesh& mesh : train.meshes) {
    if (mesh.driven < 0) continue;
    const double driven = orders[std::size_t(mesh.driven)];
    const double by_mesh = orders[std::size_t(mesh.driver)] * mesh.driver_teeth / mesh.driven_teeth;
    constexpr double rounding = 1e-9;
    if (std::abs(by_mesh - driven) <= rounding * driven) continue;
    root.fault("meshes", fmt::format("mesh {} turns {} {:.5g} times per turn of the input, another "
                                     "mesh {:.5g} times",
                                     mesh.name, train.shafts[std::size_t(mesh.driven)].name,
                                     by_mesh, driven));
  }
  return root.faults().empty() ? analysis::gear_train(train) : analysis::Kinematics{};
}

}  // namespace

std::variant<DoubtedMachine, std::vector<hal::ConfigFault>> read_machine(
    const std::string& name_or_path) {
  using Faults = std::vector<hal::ConfigFault>;
  if (shipped(name_or_path) == nullptr && is_absent(name_or_path)) {
    return Faults{{0, "",
                   "cannot be read: No such file or built-in machine" +
                       hal::what_there_is(name_or_path, names_of(kinematics_files()))}};
  }
  hal::ConfigReader root = open(name_or_path);
  if (auto fault = other_kind_fault(root, "kinematics")) return Faults{*fault};
  const std::string machine = root.text("machine");
  root.text("source", "");
  Doubts doubts;
  analysis::Kinematics kinematics = root.has("rv_reducer") ? read_rv_reducer(machine, root, doubts)
                                    : root.has("planetary")
                                        ? read_planetary(machine, root, doubts)
                                        : read_gear_train(machine, root, doubts);
  if (!root.faults().empty()) return root.faults();
  return DoubtedMachine{std::move(kinematics), std::move(doubts.list)};
}

std::variant<analysis::Kinematics, std::vector<hal::ConfigFault>> read_kinematics(
    const std::string& name_or_path) {
  auto read = read_machine(name_or_path);
  if (read.index() == 1) return std::get<1>(std::move(read));
  return std::get<0>(std::move(read)).kinematics;
}

std::string kinematics_text(const std::string& name_or_path) {
  const EmbeddedFile* file = shipped(name_or_path);
  return file != nullptr ? file->text : read_file(name_or_path).value_or("");
}

}  // namespace rvbench::bench
