#include "hal/types/measure.hpp"

#include <algorithm>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

namespace rvbench {

const std::vector<Measure>& measures() {
  using namespace measure_names;
  const std::vector<std::string_view> acceleration{"m/s²", "g"};
  const std::vector<std::string_view> number{"1"};
  using namespace channel_names;
  static const std::vector<Measure> all{
      {modulation_depth, number, "how deep a part's lines modulate the vibration"},
      {acceleration_rms, acceleration, "root mean square about the mean"},
      {acceleration_peak, acceleration, "largest distance from the mean"},
      {.name = crest_factor,
       .units = number,
       .meaning = "peak over rms; 1.41 for a sine",
       .least = 1},
      {.name = kurtosis,
       .units = number,
       .meaning = "3 for noise, 1.5 for a sine, more for blows",
       .least = 1},
      {band_rms, acceleration, "rms of a band of orders"},
      {band_peak, acceleration, "peak of a band"},
      {.name = band_crest_factor, .units = number, .meaning = "crest factor of a band", .least = 1},
      {.name = band_kurtosis, .units = number, .meaning = "kurtosis of a band", .least = 1},
      {order_level, acceleration, "amplitude at an order of a shaft or mesh"},
      {.name = envelope_order_level,
       .units = number,
       .meaning = "share of the mean envelope that it swings by at an order",
       .absent_when = "no mode is fast enough to swing at it"},
      {.name = sideband_ratio,
       .units = number,
       .meaning = "three sidebands to each side of a mesh over the mesh",
       .absent_when = "no mesh is heard well above the noise, or no angle was measured that "
                      "places its lines"},
      {.name = fm0,
       .units = number,
       .meaning = "range of a gear's average turn over its mesh lines; 2 for a sine",
       .absent_when = "no mesh is heard well above the noise, or no angle was measured that "
                      "places its lines"},
      {.name = fm4,
       .units = number,
       .meaning = "kurtosis of what a gear's average turn has beside its mesh; 3 for noise",
       .least = 1},
      {.name = na4,
       .units = number,
       .meaning = "fourth moment of what a gear's average turn has beside its mesh harmonics, over "
                  "the squared mean variance of this and earlier repeats of the point; 3 for noise",
       .absent_when = "no earlier repeat of the point is known",
       .takes_repeats = true},
      {.name = torque_ripple,
       .units = number,
       .meaning = "range of a torque over its mean",
       .shaft_channels = {input_torque}},
      {.name = efficiency,
       .units = number,
       .meaning = "power out over power in",
       .worst_is_least = true,
       .most = 1,
       .shaft_channels = {input_torque, input_angle, output_torque, output_angle}},
      {.name = transmission_error,
       .units = {"arcsec", "rad"},
       .meaning = "range of how far the output is off where the input says",
       .shaft_channels = {input_angle, output_angle}},
      {.name = lost_motion,
       .units = {"arcmin"},
       .meaning = "torsion between 3 % of the rated torque one way and the other",
       .shaft_channels = {input_torque, input_angle},
       .phase = "hysteresis_loop"},
      {.name = torsional_stiffness,
       .units = {"N·m/arcmin"},
       .meaning = "torque per torsion from half to full load",
       .worst_is_least = true,
       .shaft_channels = {input_torque, input_angle},
       .phase = "hysteresis_loop"},
      {.name = hysteresis_width,
       .units = {"arcmin"},
       .meaning = "hysteresis loss: torsion that remains at no torque",
       .shaft_channels = {input_torque, input_angle},
       .phase = "hysteresis_loop"},
  };
  return all;
}

const Measure* find_measure(std::string_view name) {
  const auto found = std::ranges::find(measures(), name, &Measure::name);
  return found == measures().end() ? nullptr : &*found;
}

double in_unit(double value, std::string_view unit, std::string_view wanted) {
  if (unit == wanted) return value;
  if (unit == "m/s²" && wanted == "g") return units::g_from_m_s2(value);
  if (unit == "g" && wanted == "m/s²") return units::m_s2_from_g(value);
  if (unit == "rad" && wanted == "arcsec") return units::arcsec_from_rad(value);
  if (unit == "arcsec" && wanted == "rad") return units::rad_from_arcsec(value);
  return not_known;
}

}  // namespace rvbench
