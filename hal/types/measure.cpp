#include "hal/types/measure.hpp"

#include <algorithm>

#include "hal/types/recording.hpp"
#include "hal/types/units.hpp"

namespace rvbench {

const std::vector<Measure>& measures() {
  using namespace measure_names;
  const std::vector<std::string_view> acceleration{"m/s²", "g"};
  const std::vector<std::string_view> number{"1"};
  static const std::vector<Measure> all{
      {modulation_depth, number, "how deep a part's lines modulate the vibration"},
      {acceleration_rms, acceleration, "root mean square about the mean"},
      {acceleration_peak, acceleration, "largest distance from the mean"},
      {crest_factor, number, "peak over rms; 1.41 for a sine"},
      {kurtosis, number, "3 for noise, 1.5 for a sine, more for blows"},
      {band_rms, acceleration, "rms of a band of orders"},
      {band_peak, acceleration, "peak of a band"},
      {band_crest_factor, number, "crest factor of a band"},
      {band_kurtosis, number, "kurtosis of a band"},
      {order_level, acceleration, "amplitude at an order of a shaft or mesh"},
      {sideband_ratio, number, "three sidebands to each side of a mesh over the mesh"},
      {fm0, number, "range of a gear's average turn over its mesh lines; 2 for a sine"},
      {fm4, number, "kurtosis of what a gear's average turn has beside its mesh; 3 for noise"},
      {torque_ripple, number, "range of a torque over its mean"},
      {efficiency, number, "power out over power in", true},
      {transmission_error,
       {"arcsec", "rad"},
       "range of how far the output is off where the input says"},
      {lost_motion, {"arcmin"}, "torsion between 3 % of the rated torque one way and the other"},
      {torsional_stiffness, {"N·m/arcmin"}, "torque per torsion from half to full load", true},
      {hysteresis_width, {"arcmin"}, "hysteresis loss: torsion that remains at no torque"},
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
