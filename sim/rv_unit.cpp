#include "sim/rv_unit.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "hal/config_reader.hpp"
#include "sim/draw.hpp"
#include "sim/preset_files.hpp"

namespace rvbench::sim {
namespace {

struct Field {
  const char* key;
  double RvDeviations::*member;
};

constexpr std::array<Field, 10> fields{{
    {"shaft_eccentricity", &RvDeviations::shaft_eccentricity_um},
    {"shaft_misalignment", &RvDeviations::shaft_misalignment_um},
    {"sun_tooth_error", &RvDeviations::sun_tooth_error_um},
    {"mesh_profile", &RvDeviations::mesh_profile_um},
    {"planet_eccentricity", &RvDeviations::planet_eccentricity_um},
    {"planet_bad_tooth", &RvDeviations::planet_bad_tooth_um},
    {"crank_error", &RvDeviations::crank_error_um},
    {"pin_spread", &RvDeviations::pin_spread_um},
    {"bad_pin", &RvDeviations::bad_pin_um},
    {"bearing_spall", &RvDeviations::bearing_spall_um},
}};

const std::string& preset_text(const std::string& preset) {
  std::string known;
  for (const EmbeddedFile& file : preset_files()) {
    if (file.name == preset) return file.text;
    known += (known.empty() ? "" : ", ") + file.name;
  }
  throw std::invalid_argument("no preset \"" + preset + "\"; there are: " + known);
}

// A deviation in tolerance is anywhere in the upper half of it; one at fault strays by a factor
// of two each way, all by the same: the severity of the unit.
RvDeviations draw_deviations(const std::string& preset, std::optional<double> wanted, Draw& draw) {
  hal::ConfigReader root = hal::ConfigReader::from_text(preset_text(preset), preset + ".json");
  root.text("about");
  hal::ConfigReader tolerances = root.object("tolerances_um");
  hal::ConfigReader faults = root.object("faults_um");
  const double drawn = draw.within_factor(2);
  const double severity = wanted.value_or(drawn);
  RvDeviations d;
  for (const Field& field : fields) {
    const double share = draw.uniform(0.5, 1);
    const double tolerance_um = tolerances.number(field.key, {0, 1000}, 0);
    const double fault_um = faults.number(field.key, {0, 1000}, 0);
    d.*field.member = std::max(fault_um * severity, tolerance_um * share);
  }
  root.finish();
  if (!root.faults().empty()) {
    throw std::logic_error(hal::describe(root.file(), root.faults().front()));
  }
  return d;
}

// The housing's modes on the drawing: assumed, dense enough that no gear line falls between them
// unheard. Each unit's are within 10 %.
constexpr std::array<double, 16> mode_Hz{190,  330,  470,  610,  760,  900,  1050, 1190,
                                         1330, 1450, 1570, 1690, 1810, 1920, 2040, 2160};
constexpr int sensors = 12;
constexpr double least_damping = 0.015, most_damping = 0.03;  // bolted steel and iron: assumed
constexpr double shape_per_sqrt_kg = 0.35;  // largest, of a modal mass of 8 kg: assumed

std::vector<HousingMode> draw_modes(Draw& draw) {
  Draw drawing(20240607);  // the shapes of the drawing: the same for every unit
  std::vector<HousingMode> modes;
  for (const double frequency_Hz : mode_Hz) {
    HousingMode mode;
    mode.frequency_Hz = frequency_Hz * draw.uniform(0.9, 1.1);
    mode.damping_ratio = draw.uniform(least_damping, most_damping);
    mode.at_ports.resize(ports::count);
    mode.at_sensors.resize(sensors);
    for (double& shape : mode.at_ports) {
      shape = shape_per_sqrt_kg * drawing.uniform(-1, 1) * draw.uniform(0.85, 1.15);
    }
    for (double& shape : mode.at_sensors) {
      shape = shape_per_sqrt_kg * drawing.uniform(-1, 1) * draw.uniform(0.85, 1.15);
    }
    modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace

// How far units and benches differ is assumed: a tenth for what is machined, a quarter for what
// wears or warms up, a factor of 1.5 for noise, 3 % for a sensor that was calibrated.
RvUnit draw_unit(const std::string& preset, std::uint64_t seed, std::optional<double> severity) {
  Draw draw(seed);
  RvUnit unit;
  unit.deviations = draw_deviations(preset, severity, draw);
  for (std::size_t i = 0; i < fields.size(); ++i) unit.phases_rad.push_back(draw.phase_rad());
  unit.marked_planet = draw.uniform(0, 1) < 0.5 ? 0 : 1;
  unit.bearing_slip = draw.uniform(-0.01, 0.01);
  unit.motor_slip_factor = draw.uniform(0.8, 1.25);
  unit.friction_factor = draw.uniform(0.8, 1.25);
  unit.noise_level_factor = draw.within_factor(1.5);
  unit.noise_colour = draw.uniform(-0.2, 0.4);
  unit.disc_mismatch = draw.uniform(-0.03, 0.03);
  for (int i = 0; i < sensors; ++i) unit.sensor_gains.push_back(draw.uniform(0.97, 1.03));
  unit.modes = draw_modes(draw);
  unit.noise_seed = draw.seed();
  return unit;
}

}  // namespace rvbench::sim
