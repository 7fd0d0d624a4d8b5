#include "analysis/order/sidebands.hpp"

#include <cmath>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/order/order_spectrum.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double carrier = 20, shaft = 1, cage = 0.4;

// The modulation that was found nearest to a spacing.
Modulation near(const Sidebands& found, double spacing) {
  Modulation nearest;
  for (const Modulation& each : found.modulations) {
    if (std::abs(each.spacing - spacing) < std::abs(nearest.spacing - spacing)) nearest = each;
  }
  return nearest;
}

std::string with_error(double value, double error) {
  return rounded(value, 3) + " ± " + rounded(error, 3);
}

Panel around_carrier(const Spectrum& orders) {
  return {"Order spectrum around the carrier",
          {"order", 18, 22},
          {"m/s²", 0, 0.15},
          {{"", 0, orders.resolution, orders.amplitude}},
          {{carrier - shaft, "-1, AM"},
           {carrier - cage, "-0.4, PM"},
           {carrier, "carrier (cut off)"},
           {carrier + cage, "+0.4, PM"},
           {carrier + shaft, "+1, AM"}}};
}

}  // namespace

Example sidebands_example() {
  //! [page]
  const Eigen::ArrayXd turns = times_s(200 * 128, 128);
  const Eigen::ArrayXd amplitude = 1 + 0.20 * wave(1.0 * turns).array();
  const Eigen::ArrayXd phase_cycles = 0.15 / units::two_pi * wave(0.4 * turns).array();
  const Eigen::VectorXd x =
      amplitude * wave(20 * turns + phase_cycles).array() + 0.1 * noise(200 * 128, 1).array();

  const OverAngle even{.samples = x, .samples_per_turn = 128};
  const Sidebands found = sidebands_of(even, {.carrier_order = 20, .reach_order = 4});
  //! [page]
  const Modulation am = near(found, shaft), pm = near(found, cage);
  return {"sidebands",
          "Sidebands: amplitude or phase",
          "A mesh line at order 20 whose amplitude swings by 0.2 at order 1 and whose phase swings "
          "by 0.15 rad at order 0.4, in noise. In the spectrum both are a pair of lines beside the "
          "carrier; which is which only modulus and phase tell, each with its error.",
          {"order/sidebands.hpp"},
          {{"order of the carrier", "20.000", rounded(found.carrier_order, 3)},
           {"amplitude of the carrier [m/s²]", "1.00", rounded(found.carrier_amplitude, 2)},
           {"modulations that are more than noise", "2", std::to_string(found.modulations.size())},
           {"spacing of the first", "1.000", rounded(am.spacing, 3)},
           {"its swing of the amplitude", "0.200", with_error(am.am_depth, am.am_error)},
           {"its swing of the phase [rad]", "0.000", with_error(am.pm_index_rad, am.pm_error_rad)},
           {"spacing of the second", "0.400", rounded(pm.spacing, 3)},
           {"its swing of the amplitude", "0.000", with_error(pm.am_depth, pm.am_error)},
           {"its swing of the phase [rad]", "0.150", with_error(pm.pm_index_rad, pm.pm_error_rad)}},
          {around_carrier(order_spectrum(even)),
           Bars{"Swings that were found",
                {"depth, or rad", 0, 0.25},
                {"amplitude", "phase [rad]"},
                {{"at order 1", {am.am_depth, am.pm_index_rad}},
                 {"at order 0.4", {pm.am_depth, pm.pm_index_rad}}}}}};
}

}  // namespace rvbench::analysis::examples
