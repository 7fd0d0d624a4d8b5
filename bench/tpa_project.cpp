#include "bench/tpa_project.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "analysis/frf/signed_axis.hpp"
#include "analysis/tpa/regularisation_rule.hpp"
#include "bench/file_kind.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/tpa_methods.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

using Places = std::vector<DegreeOfFreedom>;

constexpr hal::Bounds frequencies{0, 1e6};
constexpr hal::Bounds ranges{1e-6, 1e9};

class ProjectReader {
 public:
  explicit ProjectReader(hal::ConfigReader& root)
      : root_(root), folder_(root.file().parent_path()) {}

  TpaProject read() {
    project_.name = root_.text("tpa");
    const NamedTpaMethod& method = read_method();
    if (method.needs_frfs) {
      project_.paths = read_places(root_, "paths");
      read_frfs();
    }
    read_sensors(method);
    read_bands();
    read_settings(method);
    method.read(root_, project_);
    read_motions();
    return std::move(project_);
  }

 private:
  // The file that a key names, seen from the project's folder.
  std::string file_at(hal::ConfigReader& at, const char* key) {
    const std::string name = at.text(key);
    if (name.empty()) return name;
    const std::filesystem::path file = folder_ / name;
    if (is_absent(file)) at.fault(key, "there is no file " + hal::in_quotes(file.string()));
    return file.string();
  }

  const NamedTpaMethod& read_method() {
    std::vector<std::string_view> names;
    for (const NamedTpaMethod& method : tpa_methods()) names.push_back(method.name);
    project_.method = root_.choice("method", names, std::string(names.front()));
    return tpa_method(project_.method);
  }

  void read_frfs() {
    const bool has_ready = root_.has("frfs"), has_hammer = root_.has("hammer");
    if (has_ready == has_hammer) {
      root_.fault("", "give \"frfs\" or \"hammer\", one of them and one only");
    }
    if (has_ready) {
      for (const std::string& name : root_.texts("frfs")) {
        const std::filesystem::path file = folder_ / name;
        if (is_absent(file))
          root_.fault("frfs", "there is no file " + hal::in_quotes(file.string()));
        project_.frf_files.push_back(file.string());
      }
    }
    if (has_hammer) read_hammer(root_.object("hammer"));
  }

  void read_hammer(hal::ConfigReader json) {
    TpaHammer hammer;
    hammer.channel = json.text("channel");
    if (json.has("range_N")) hammer.range_N = json.number("range_N", ranges);
    if (json.has("acceleration_range_m_s2")) {
      hammer.acceleration_range_m_s2 = json.number("acceleration_range_m_s2", ranges);
    }
    Places hit;
    for (hal::ConfigReader& entry : json.objects("hits")) {
      const std::string file = file_at(entry, "file");
      hammer.hits.push_back({file, {entry.text("point"), entry.text("direction")}});
      hit.push_back(analysis::positive(hammer.hits.back().place));
      if (!project_.paths.empty() && !analysis::holds(project_.paths, hit.back())) {
        entry.fault("point", analysis::name_of(hit.back()) + " is none of the paths");
      }
    }
    for (const DegreeOfFreedom& path : project_.paths) {
      if (!analysis::holds(hit, path))
        json.fault("hits", "no hit at the path " + analysis::name_of(path));
    }
    project_.hammer = std::move(hammer);
  }

  void read_sensors(const NamedTpaMethod& method) {
    hal::ConfigReader sensors = root_.object("sensors");
    project_.indicators = read_places(sensors, "indicators");
    project_.targets = read_places(sensors, "targets");
    if (method.needs_frfs) {
      project_.validation = read_places(sensors, "validation");
    } else if (sensors.has("validation")) {
      sensors.fault("validation", project_.method + " is validated by blocks that are held out");
    }
    for (const DegreeOfFreedom& place : project_.indicators) {
      if (analysis::holds(project_.targets, place)) {
        sensors.fault("indicators", analysis::name_of(place) + " is a target as well");
      }
      if (analysis::holds(project_.validation, place)) {
        sensors.fault("indicators", analysis::name_of(place) + " is to validate as well");
      }
    }
  }

  void read_bands() {
    for (hal::ConfigReader& entry : root_.objects("bands")) {
      const analysis::TpaBand band{entry.number("from_Hz", frequencies),
                                   entry.number("to_Hz", frequencies)};
      if (!(band.last_Hz > band.first_Hz)) entry.fault("to_Hz", "must be above from_Hz");
      project_.bands.push_back(band);
    }
    if (project_.bands.empty()) root_.fault("bands", "no band");
  }

  void read_settings(const NamedTpaMethod& method) {
    std::vector<std::string_view> names;
    for (const analysis::NamedRule& rule : analysis::regularisation_rules()) {
      names.push_back(rule.name);
    }
    project_.rule = root_.choice("rule", names, project_.rule);
    if (method.needs_frfs) {
      project_.least_coherence = root_.number("least_coherence", {0, 1}, project_.least_coherence);
    }
    auto json = root_.optional_object("resampling");
    if (!json) return;
    analysis::Resampling& resampling = project_.resampling;
    resampling.replicates = json->integer("replicates", {20, 10000}, resampling.replicates);
    resampling.seed = static_cast<std::uint64_t>(json->integer("seed", {0, 2147483647}, 1));
  }

  void read_motions() {
    std::set<std::string> names;
    for (hal::ConfigReader& entry : root_.objects("motions")) {
      TpaMotion motion;
      motion.name = entry.text("name");
      if (!names.insert(motion.name).second) {
        entry.fault("name", "another motion is called " + hal::in_quotes(motion.name));
      }
      motion.recording = file_at(entry, "recording");
      if (entry.has("after")) motion.after = file_at(entry, "after");
      if (auto reducer = entry.optional_object("reducer")) motion.reducer = read_reducer(*reducer);
      project_.motions.push_back(std::move(motion));
    }
    if (project_.motions.empty()) root_.fault("motions", "no motion");
  }

  TpaReducer read_reducer(hal::ConfigReader& json) {
    TpaReducer reducer{json.text("joint"), file_at(json, "recording"),
                       json.has("after") ? file_at(json, "after") : "", json.text("kinematics")};
    const bool is_known = std::ranges::any_of(project_.paths, [&](const DegreeOfFreedom& path) {
      return joint_of(path) == reducer.joint;
    });
    if (!is_known && !reducer.joint.empty()) {
      json.fault("joint", "no path is at a joint " + hal::in_quotes(reducer.joint));
    }
    if (reducer.kinematics.empty()) return reducer;
    // A machine that is shipped, or a file beside the project.
    if (!is_absent(folder_ / reducer.kinematics)) {
      reducer.kinematics = (folder_ / reducer.kinematics).string();
    }
    const auto machine = read_kinematics(reducer.kinematics);
    if (machine.index() == 1) {
      json.fault("kinematics", hal::describe(reducer.kinematics, std::get<1>(machine).front()));
    }
    return reducer;
  }

  hal::ConfigReader& root_;
  std::filesystem::path folder_;
  TpaProject project_;
};

}  // namespace

std::variant<TpaProject, std::vector<hal::ConfigFault>> read_tpa_project(const std::string& file) {
  using Faults = std::vector<hal::ConfigFault>;
  hal::ConfigReader root = hal::ConfigReader::from_file(file);
  if (auto fault = other_kind_fault(root, "tpa")) return Faults{*fault};
  TpaProject project = ProjectReader(root).read();
  root.finish();
  if (!root.faults().empty()) return root.faults();
  return project;
}

std::vector<DegreeOfFreedom> read_places(hal::ConfigReader& of, const char* key) {
  hal::ConfigReader list = of.object(key);
  Places all;
  const std::vector<std::string> directions = list.texts("directions");
  for (const std::string& direction : directions) {
    if (direction.empty()) list.fault("directions", "a direction is empty");
  }
  for (const std::string& point : list.texts("points")) {
    for (const std::string& direction : directions) {
      const DegreeOfFreedom place = analysis::positive({point, direction});
      if (analysis::holds(all, place)) list.fault("", analysis::name_of(place) + " is there twice");
      all.push_back(place);
    }
  }
  return all;
}

std::string joint_of(const DegreeOfFreedom& path) {
  return path.point.substr(0, path.point.find(' '));
}

}  // namespace rvbench::bench
