#include "bench/kinematics_file.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "analysis/gear_train.hpp"
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

analysis::BearingGeometry read_bearing(hal::ConfigReader& b) {
  analysis::BearingGeometry geometry{
      .rolling_elements = b.integer("rolling_elements", {2, 1000}),
      .ball_diameter_mm = b.number("ball_diameter_mm", length_mm),
      .pitch_diameter_mm = b.number("pitch_diameter_mm", length_mm),
      .contact_angle_deg = b.number("contact_angle_deg", {0, 89}, 0)};
  b.text("assumption", "");
  if (geometry.ball_diameter_mm >= geometry.pitch_diameter_mm) {
    b.fault("ball_diameter_mm", "must be below pitch_diameter_mm");
  }
  return geometry;
}

analysis::Kinematics read_rv_reducer(const std::string& machine, hal::ConfigReader& root) {
  hal::ConfigReader rv = root.object("rv_reducer");
  const analysis::RvGeometry geometry{.sun_teeth = rv.integer("sun_teeth", teeth),
                                      .planet_teeth = rv.integer("planet_teeth", teeth),
                                      .planets = rv.integer("planets", {1, 12}, 2),
                                      .lobes = rv.integer("lobes", teeth),
                                      .pins = rv.integer("pins", teeth)};
  if (geometry.pins != geometry.lobes + 1) {
    rv.fault("pins", "must be one more than lobes (" + std::to_string(geometry.lobes) + ")");
  }
  analysis::BearingGeometry bearing;
  if (auto b = rv.optional_object("crank_bearing")) bearing = read_bearing(*b);
  const double rated_Nm = rv.has("rated_output_torque_Nm")
                              ? rv.number("rated_output_torque_Nm", {0.1, 100000})
                              : not_known;
  root.finish();
  if (!root.faults().empty()) return {};
  analysis::Kinematics kinematics = analysis::rv_reducer(machine, geometry, bearing);
  kinematics.rated_output_torque_Nm = rated_Nm;
  return kinematics;
}

// Names of shafts to their places in the list; a name that is not there is a fault.
class ShaftNames {
 public:
  void add(hal::ConfigReader& at, const std::string& name) {
    if (!index_.emplace(name, static_cast<int>(index_.size())).second) {
      at.fault("name", "there is already a shaft \"" + name + "\"");
    }
  }
  int find(hal::ConfigReader& at, const char* key) const {
    const std::string name = at.text(key);
    const auto found = index_.find(name);
    if (found != index_.end()) return found->second;
    at.fault(key, "no shaft is called \"" + name + "\"");
    return 0;
  }

 private:
  std::map<std::string, int> index_;
};

analysis::GearTrain::Mesh read_mesh(hal::ConfigReader& m, const ShaftNames& shafts) {
  analysis::GearTrain::Mesh mesh;
  mesh.name = m.text("name");
  mesh.driver = shafts.find(m, "driver");
  mesh.driver_teeth = m.integer("driver_teeth", teeth);
  mesh.driver_component = m.text("driver_component", mesh.name + " driver");
  if (m.has("driven")) {
    mesh.driven = shafts.find(m, "driven");
    mesh.driven_teeth = m.integer("driven_teeth", teeth);
    mesh.driven_component = m.text("driven_component", mesh.name + " driven");
  }
  return mesh;
}

analysis::Kinematics read_gear_train(const std::string& machine, hal::ConfigReader& root) {
  analysis::GearTrain train;
  train.machine = machine;
  ShaftNames names;
  for (hal::ConfigReader& s : root.objects("shafts")) {
    const std::string name = s.text("name");
    names.add(s, name);
    train.shafts.push_back({name, s.text("component", name)});
  }
  for (hal::ConfigReader& m : root.objects("meshes", false)) {
    train.meshes.push_back(read_mesh(m, names));
  }
  for (hal::ConfigReader& b : root.objects("bearings", false)) {
    analysis::GearTrain::Bearing bearing;
    bearing.name = b.text("name");
    bearing.shaft = names.find(b, "shaft");
    bearing.slip = b.number("slip", {0, 0.1}, bearing.slip);
    bearing.geometry = read_bearing(b);
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
  return root.faults().empty() ? analysis::gear_train(train) : analysis::Kinematics{};
}

}  // namespace

std::variant<analysis::Kinematics, std::vector<hal::ConfigFault>> read_kinematics(
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
  analysis::Kinematics kinematics =
      root.has("rv_reducer") ? read_rv_reducer(machine, root) : read_gear_train(machine, root);
  if (!root.faults().empty()) return root.faults();
  return kinematics;
}

std::string kinematics_text(const std::string& name_or_path) {
  const EmbeddedFile* file = shipped(name_or_path);
  return file != nullptr ? file->text : read_file(name_or_path).value_or("");
}

}  // namespace rvbench::bench
