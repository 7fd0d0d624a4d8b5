#include "analysis/indicators/channel_indicators.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "analysis/indicators/gear_condition.hpp"
#include "analysis/indicators/indicator_places.hpp"
#include "analysis/indicators/order_bands.hpp"
#include "analysis/indicators/order_levels.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/line_floor.hpp"
#include "analysis/order/mesh_residual.hpp"
#include "analysis/order/resolution.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::analysis {
namespace {

namespace names = measure_names;

constexpr Eigen::Index fewest_samples = 16;  // of a band: its moments mean nothing below
constexpr int sidebands = 3;
constexpr int most_harmonics = 4;           // of the mesh, in FM0
constexpr double equal_orders = 1e-6;       // relative
constexpr double rounding = 1e-9;           // relative: what is left of an average that is all mesh
constexpr double above_line_noise = 20;     // amplitude of a mesh, for its sideband ratio
constexpr double above_average_noise = 12;  // sum of the mesh's harmonics, for FM0

class List {
 public:
  explicit List(std::string unit) : unit_(std::move(unit)) {}
  void add(std::string_view measure, const std::string& of, std::optional<double> value) {
    put(measure, of, value, "1");
  }
  void add_level(std::string_view measure, const std::string& of, std::optional<double> value) {
    put(measure, of, value, unit_);
  }
  std::vector<Indicator> sorted() {
    // In the order of measures(), so that each stands together.
    std::vector<Indicator> sorted;
    for (const Measure& measure : measures()) {
      std::ranges::copy_if(all_, std::back_inserter(sorted),
                           [&](const Indicator& i) { return i.measure == measure.name; });
    }
    return sorted;
  }

 private:
  void put(std::string_view measure, const std::string& of, std::optional<double> value,
           const std::string& unit) {
    if (value && std::isfinite(*value)) all_.push_back({std::string(measure), of, *value, unit});
  }

  std::string unit_;
  std::vector<Indicator> all_;
};

void add_whole(const Channel& x, List& list) {
  const SignalLevels levels = signal_levels(x.samples);
  list.add_level(names::acceleration_rms, "", levels.rms);
  list.add_level(names::acceleration_peak, "", levels.peak);
  if (!(levels.rms > 0)) return;  // a constant has neither
  list.add(names::crest_factor, "", levels.crest_factor);
  list.add(names::kurtosis, "", levels.kurtosis);
}

void add_bands(const OrderLines& lines, const Kinematics& kinematics, List& list) {
  for (const OrderBand& band : order_bands(kinematics)) {
    const Eigen::VectorXd x = lines.between(band.from, band.to);
    if (x.size() < fewest_samples) continue;
    const SignalLevels levels = signal_levels(x);
    list.add_level(names::band_rms, band.name, levels.rms);
    list.add_level(names::band_peak, band.name, levels.peak);
    if (!(levels.rms > 0)) continue;
    list.add(names::band_crest_factor, band.name, levels.crest_factor);
    list.add(names::band_kurtosis, band.name, levels.kurtosis);
  }
}

void add_orders(const OrderLines& lines, const Spectrum& spectrum, double near,
                const Kinematics& kinematics, List& list) {
  for (const CharacteristicOrder& o : locked_orders(kinematics)) {
    if (o.order > lines.top_order() || !are_parted(o.order, 0, lines.turns())) continue;
    list.add_level(names::order_level, o.name, level_at_order(spectrum, o.order, near * o.order));
  }
}

// What of a channel is asked for, order by order.
struct Task {
  const OrderLines& lines;
  const Spectrum& spectrum;
  const LineFloor& floor;
  const Kinematics& kinematics;
  const std::vector<SpectralLine>& heard;

  // Of several parts at one order a line bears the first one's name.
  bool hears(double mesh_order) const {
    return std::ranges::any_of(kinematics.orders, [&](const CharacteristicOrder& o) {
      return std::abs(o.order - mesh_order) <= equal_orders * mesh_order &&
             std::ranges::find(heard, o.name, &SpectralLine::meaning) != heard.end();
    });
  }
  bool places(double order) const {
    return is_placed(order, lines.turns(), speed_error(lines.angle_is_measured()));
  }
  Eigen::Index line_at(double order) const {
    const auto line = static_cast<Eigen::Index>(std::lround(order / spectrum.resolution));
    return std::min(line, floor.power.size() - 1);
  }
};

bool stands_clear(const Task& task, double mesh_order) {
  const Eigen::Index line = task.line_at(mesh_order);
  return task.floor.power[line] > above_line_noise * above_line_noise * task.floor.floor[line];
}

void add_sidebands(const Task& task, List& list) {
  for (const SidebandPlace& place : sideband_places(task.kinematics)) {
    const double last = place.mesh.order + sidebands * place.spacing;
    if (!task.hears(place.mesh.order) || last > task.lines.top_order()) continue;
    if (!task.places(last)) continue;
    if (!are_parted(place.spacing, 0, task.lines.turns())) continue;
    if (!stands_clear(task, place.mesh.order)) continue;
    list.add(names::sideband_ratio, place.name,
             sideband_ratio(task.spectrum, place.mesh.order, place.spacing, sidebands));
  }
}

// Rms of what noise leaves in the average turn of a gear: on each of its lines. One under a Hann
// window holds 1.5 times the noise of one without, and a line of amplitude a has a power of a²/2.
double noise_of_average(const Task& task, double gear_order) {
  double power = 0;
  for (double order = gear_order; order <= task.lines.top_order(); order += gear_order) {
    power += task.floor.floor[task.line_at(order)] / 1.5 / 2;
  }
  return std::sqrt(power);
}

std::optional<double> fm0_above_noise(const Task& task, const Eigen::VectorXd& average,
                                      const MeshingGear& gear, int harmonics) {
  const std::optional<double> ratio = fm0(average, gear.teeth, harmonics);
  if (!ratio) return std::nullopt;
  const double mesh = (average.maxCoeff() - average.minCoeff()) / *ratio;
  if (mesh < above_average_noise * noise_of_average(task, gear.order)) return std::nullopt;
  return ratio;
}

// An average without what its own mesh does regularly, and without the meshes of others. With the
// first sidebands it is the residual of NA4, without them the difference of FM4.
Eigen::VectorXd beside_meshes(const Eigen::VectorXd& average, const MeshingGear& gear,
                              const Kinematics& kinematics, int regular_sidebands) {
  Eigen::VectorXd rest = mesh_residual(
      average, {.mesh_lines = gear.teeth, .shaft_lines = 1, .sidebands = regular_sidebands});
  for (const CharacteristicOrder& other : kinematics.orders) {
    if (!other.mesh) continue;
    const double line = other.order / gear.order;
    const auto whole = static_cast<int>(std::lround(line));
    if (std::abs(line - whole) > 1e-6 || whole == gear.teeth) continue;
    if (whole < 1 || whole > rest.size() / 2) continue;
    rest = mesh_residual(rest, {.mesh_lines = whole, .shaft_harmonics = 0});
  }
  return rest;
}

double rms(const Eigen::VectorXd& x) { return std::sqrt(x.squaredNorm() / double(x.size())); }

std::vector<GearResidual> add_gears(const Task& task, List& list) {
  std::vector<GearResidual> residuals;
  for (const GearPlace& place : gear_places(task.kinematics)) {
    const double mesh_order = place.gear.teeth * place.gear.order;
    if (!task.places(mesh_order)) continue;
    const Eigen::VectorXd average = task.lines.average_turn(place.gear.order);
    const Eigen::Index below_half = (average.size() - 1) / (2 * place.gear.teeth);
    const int harmonics = std::min({most_harmonics, static_cast<int>(below_half),
                                    static_cast<int>(task.lines.top_order() / mesh_order)});
    if (average.size() == 0 || harmonics < 1) continue;
    if (task.hears(mesh_order)) {
      list.add(names::fm0, place.name, fm0_above_noise(task, average, place.gear, harmonics));
    }
    const double least = rounding * rms(average);
    const Eigen::VectorXd difference = beside_meshes(average, place.gear, task.kinematics, 1);
    if (rms(difference) > least) list.add(names::fm4, place.name, fm4(difference));
    const Eigen::VectorXd residual = beside_meshes(average, place.gear, task.kinematics, 0);
    if (rms(residual) > least) residuals.push_back({place.name, residual_moments(residual)});
  }
  return residuals;
}

}  // namespace

ChannelIndicators channel_indicators(const Channel& x, const OrderLines& lines,
                                     const Kinematics& kinematics,
                                     const std::vector<SpectralLine>& heard) {
  List list(x.info.unit);
  add_whole(x, list);
  if (lines.empty()) return {list.sorted(), {}};
  const Spectrum& spectrum = lines.spectrum();
  const LineFloor floor = line_floor(
      spectrum, static_cast<Eigen::Index>(std::lround(lines.turns() / kinematics.period_turns)));
  const Task task{lines, spectrum, floor, kinematics, heard};
  add_bands(lines, kinematics, list);
  add_orders(lines, spectrum, speed_error(lines.angle_is_measured()), kinematics, list);
  add_sidebands(task, list);
  std::vector<GearResidual> residuals = add_gears(task, list);
  return {list.sorted(), std::move(residuals)};
}

}  // namespace rvbench::analysis
