#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/order/order_map.hpp"
#include "analysis/order/order_spectrum.hpp"
#include "analysis/order/over_angle.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double highest_order = 20;

double amplitude_at(const Spectrum& spectrum, double axis) {
  return spectrum.amplitude[std::lround(axis / spectrum.resolution)];
}

// The highest line within 10 % of a frequency that an order is at in the middle.
double highest_near(const Spectrum& spectrum, double frequency_Hz) {
  const auto from = std::lround(0.9 * frequency_Hz / spectrum.resolution);
  const auto to = std::lround(1.1 * frequency_Hz / spectrum.resolution);
  return spectrum.amplitude.segment(from, to - from).maxCoeff();
}

Map drawn(const OrderMap& map) {
  Map picture{
      "Order map: orders stand, 300 Hz crosses", {"order", 0, highest_order}, "time [s]", 1, {}};
  const auto shown = static_cast<Eigen::Index>(highest_order / map.resolution);
  for (Eigen::Index block = 0; block < map.amplitude.cols(); ++block) {
    const bool is_labelled = block % 10 == 0;
    picture.rows.push_back(
        {is_labelled ? rounded(map.time_s[block], 1) : "", map.amplitude.col(block).head(shown)});
  }
  return picture;
}

}  // namespace

Example order_tracking_example() {
  //! [page]
  // A run-up from 15 to 35 rev/s in 16 s; two orders, and a hum that is locked to time.
  const Eigen::ArrayXd t_s = times_s(64000, 4000);
  const Eigen::ArrayXd turns = 15 * t_s + 0.625 * t_s.square();
  const Eigen::VectorXd x =
      wave(7.5 * turns) + 0.5 * wave(12 * turns) + 0.5 * wave(300 * t_s) + 0.1 * noise(64000, 1);
  const auto angle = *ShaftAngle::of_turns(turns, 0, 1 / 4000.0);

  const OverAngle even = over_angle(x, 4000, 0, angle, {.samples_per_turn = 64});
  const Spectrum orders = order_spectrum(even);
  const OrderMap map = order_map(even, angle, 10);
  //! [page]
  const Spectrum over_time = amplitude_spectrum(x, 4000, Window::hann);
  const Eigen::Index last = map.amplitude.cols() - 1;
  Eigen::Index hum = 0;
  map.amplitude.col(last).segment(80, 15).maxCoeff(&hum);
  return {"order_tracking",
          "Angular resampling, order spectrum and order map",
          "A shaft runs up from 15 to 35 rev/s in 16 s. What it sheds at order 7.5 (amplitude 1) "
          "and at order 12 (0.5) sweeps over frequencies, and is nowhere in a spectrum over "
          "frequency; over the angle both are single lines. A hum at 300 Hz is none of the "
          "shaft's: it crosses the map from order 20 to order 8.6.",
          {"order/over_angle.hpp", "order/order_spectrum.hpp", "order/order_map.hpp"},
          {{"amplitude at order 7.5 [m/s²]", "1.000", rounded(amplitude_at(orders, 7.5), 3)},
           {"amplitude at order 12 [m/s²]", "0.500", rounded(amplitude_at(orders, 12), 3)},
           {"highest line within 10 % of 7.5 times the mean speed, over frequency [m/s²]", "–",
            rounded(highest_near(over_time, 7.5 * 25), 2)},
           {"order of the hum in the last block", rounded(300 / map.speed_Hz[last], 1),
            rounded(map.resolution * double(80 + hum), 1)}},
          {Panel{"Over frequency",
                 {"frequency [Hz]", 0, 450},
                 {"m/s²", 0, 1.1},
                 {{"", 0, over_time.resolution, over_time.amplitude}}},
           Panel{"Over orders",
                 {"order", 0, highest_order},
                 {"m/s²", 0, 1.1},
                 {{"", 0, orders.resolution, orders.amplitude}}},
           drawn(map)}};
}

}  // namespace rvbench::analysis::examples
