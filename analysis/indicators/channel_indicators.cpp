#include "analysis/indicators/channel_indicators.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "analysis/indicators/gear_condition.hpp"
#include "analysis/indicators/indicator_places.hpp"
#include "analysis/indicators/order_bands.hpp"
#include "analysis/indicators/order_levels.hpp"
#include "analysis/indicators/signal_levels.hpp"
#include "analysis/order/mesh_residual.hpp"
#include "analysis/order/resolution.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::analysis {
namespace {

namespace names = measure_names;

constexpr Eigen::Index fewest_samples = 16;  // of a band: its moments mean nothing below
constexpr int sidebands = 3;
constexpr int most_harmonics = 4;  // of the mesh, in FM0
constexpr double rounding = 1e-9;  // relative: what is left of an average that is all mesh

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
    // By first appearance of the measure, so that each stands together.
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

bool is_parted(double spacing, double turns) { return spacing * turns > lines_to_part - 1e-6; }

void add_orders(const OrderLines& lines, const Spectrum& spectrum, double near,
                const Kinematics& kinematics, List& list) {
  for (const CharacteristicOrder& o : locked_orders(kinematics)) {
    if (o.order > lines.top_order() || !is_parted(o.order, lines.turns())) continue;
    list.add_level(names::order_level, o.name, level_at_order(spectrum, o.order, near * o.order));
  }
}

bool is_heard(const std::string& mesh, const std::vector<SpectralLine>& heard) {
  return std::ranges::find(heard, mesh, &SpectralLine::meaning) != heard.end();
}

void add_sidebands(const OrderLines& lines, const Spectrum& spectrum, const Kinematics& kinematics,
                   const std::vector<SpectralLine>& heard, List& list) {
  for (const SidebandPlace& place : sideband_places(kinematics)) {
    const double last = place.mesh.order + sidebands * place.spacing;
    if (!is_heard(place.mesh.name, heard) || last > lines.top_order()) continue;
    if (!is_parted(place.spacing, lines.turns())) continue;
    list.add(names::sideband_ratio, place.name,
             sideband_ratio(spectrum, place.mesh.order, place.spacing, sidebands));
  }
}

// Without what its own mesh does regularly, and without the meshes of others.
Eigen::VectorXd difference_of(const Eigen::VectorXd& average, const MeshingGear& gear,
                              const Kinematics& kinematics) {
  Eigen::VectorXd difference =
      mesh_residual(average, {.mesh_lines = gear.teeth, .shaft_lines = 1, .sidebands = 1});
  for (const CharacteristicOrder& other : kinematics.orders) {
    if (!other.mesh) continue;
    const double line = other.order / gear.order;
    const auto whole = static_cast<int>(std::lround(line));
    if (std::abs(line - whole) > 1e-6 || whole == gear.teeth) continue;
    if (whole < 1 || whole > difference.size() / 2) continue;
    difference = mesh_residual(difference, {.mesh_lines = whole, .shaft_harmonics = 0});
  }
  return difference;
}

double rms(const Eigen::VectorXd& x) { return std::sqrt(x.squaredNorm() / double(x.size())); }

void add_gears(const OrderLines& lines, const Kinematics& kinematics,
               const std::vector<SpectralLine>& heard, List& list) {
  for (const GearPlace& place : gear_places(kinematics)) {
    const Eigen::VectorXd average = lines.average_turn(place.gear.order);
    const double mesh_order = place.gear.teeth * place.gear.order;
    const Eigen::Index below_half = (average.size() - 1) / (2 * place.gear.teeth);
    const int harmonics = std::min({most_harmonics, static_cast<int>(below_half),
                                    static_cast<int>(lines.top_order() / mesh_order)});
    if (average.size() == 0 || harmonics < 1) continue;
    if (is_heard(place.mesh, heard)) {
      list.add(names::fm0, place.name, fm0(average, place.gear.teeth, harmonics));
    }
    const Eigen::VectorXd difference = difference_of(average, place.gear, kinematics);
    if (!(rms(difference) > rounding * rms(average))) continue;
    list.add(names::fm4, place.name, fm4(difference));
  }
}

}  // namespace

std::vector<Indicator> channel_indicators(const Channel& x, const OrderLines& lines,
                                          const Kinematics& kinematics,
                                          const std::vector<SpectralLine>& heard) {
  List list(x.info.unit);
  add_whole(x, list);
  if (lines.empty()) return list.sorted();
  const Spectrum spectrum = lines.spectrum();
  add_bands(lines, kinematics, list);
  add_orders(lines, spectrum, lines.angle_is_measured() ? 0 : stated_speed_error, kinematics, list);
  add_sidebands(lines, spectrum, kinematics, heard, list);
  add_gears(lines, kinematics, heard, list);
  return list.sorted();
}

}  // namespace rvbench::analysis
