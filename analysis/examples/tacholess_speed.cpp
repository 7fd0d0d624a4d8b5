#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/order/line_phase.hpp"
#include "analysis/order/line_ridge.hpp"
#include "analysis/shaft_speed.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double rate_Hz = 4000;

// Mean speed of 0.1 s, each 0.02 s from 3 to 17 s.
Eigen::VectorXd speeds_Hz(const ShaftAngle& angle) {
  Eigen::VectorXd speeds(701);
  for (Eigen::Index i = 0; i < speeds.size(); ++i) {
    const double at_s = 3 + 0.02 * static_cast<double>(i);
    speeds[i] = (angle.turns_at(at_s + 0.05) - angle.turns_at(at_s - 0.05)) / 0.1;
  }
  return speeds;
}

double highest_error(const Eigen::VectorXd& found, const Eigen::VectorXd& known) {
  return (found.array() / known.array() - 1).abs().maxCoeff();
}

std::vector<Plot> plots(const LineRidge& ridge, const Eigen::VectorXd& found_Hz,
                        const Eigen::VectorXd& known_Hz) {
  return {Panel{"The line that is followed",
                {"time [s]", 0, 20},
                {"mesh frequency [Hz]", 410, 465},
                {{"ridge", ridge.start_s, ridge.step_s, ridge.frequency_Hz},
                 {"known", 3, 0.02, 23 * known_Hz}}},
          Panel{"The speed by its phase",
                {"time [s]", 5, 8},
                {"speed [rev/s]", 18.45, 18.85},
                {{"by phase", 3, 0.02, found_Hz}, {"known", 3, 0.02, known_Hz}}}};
}

}  // namespace

Example tacholess_speed_example() {
  //! [page]
  // 18 rev/s and rising, with a ripple of 0.1 % at 2 Hz; a mesh of 23 teeth, heard in noise.
  const Eigen::ArrayXd t_s = times_s(80000, 4000);
  const Eigen::ArrayXd ripple = (units::two_pi * 2 * t_s).sin() / (units::two_pi * 2);
  const Eigen::ArrayXd turns = 18 * t_s + 0.05 * t_s.square() + 0.018 * ripple;
  const Eigen::VectorXd x = wave(23 * turns) + wave(46 * turns) + 0.3 * noise(80000, 1);

  const LineRidge ridge =
      *line_ridge(x, 4000, {.from_Hz = 350, .to_Hz = 600, .block_s = 1, .most_change_Hz_s = 20});
  const LinePhase line = *line_phase(x, 4000, ridge, 20);
  const ShaftAngle angle = *angle_of_line(line, 0, 23);

  const Channel channel{{"accel_1x", "m/s²", "+X", not_known}, 4000, 0, x};
  const std::vector<ShaftSpeed> coarse = shaft_speeds(
      {channel}, {.orders = {23, 46}, .turns_per_sample = 19.0 / 4000, .within = 0.1}, 8000);
  //! [page]
  const auto known = *ShaftAngle::of_turns(turns, 0, 1 / rate_Hz);
  const Eigen::VectorXd found_Hz = speeds_Hz(angle), known_Hz = speeds_Hz(known);
  const double in_second_block_Hz = known.turns_at(3) / 2 - known.turns_at(1) / 2;
  return {"tacholess_speed",
          "Speed without a tachometer",
          "A shaft at 18 rev/s that gains 0.1 rev/s each second, with a ripple of 0.1 % at 2 Hz. "
          "All that is recorded is the vibration of a mesh of 23 teeth in noise. The ridge follows "
          "the line through blocks of 1 s; its phase, demodulated along the ridge, is the angle of "
          "the shaft, ripple and all. Several lines together tell the speed of each block as well.",
          {"order/line_ridge.hpp", "order/line_phase.hpp", "shaft_speed.hpp"},
          {{"speed in the block from 1 to 3 s, by two lines [rev/s]",
            rounded(in_second_block_Hz, 2), rounded(coarse.at(1).turns_per_sample * rate_Hz, 2)},
           {"mesh frequency at 10 s, by the ridge [Hz]", rounded(23 * 19.0, 1),
            rounded(ridge.frequency_Hz[19], 1)},
           {"mean frequency of the line, by its phase [Hz]", "437.00",
            rounded(line.mean_frequency_Hz(), 2)},
           {"largest error of the speed from 3 to 17 s, by the phase [‰]", "0",
            rounded(1000 * highest_error(found_Hz, known_Hz), 1)},
           {"line over noise in its band [dB]", "–",
            rounded(10 * std::log10(line.carrier_over_noise), 0)}},
          plots(ridge, found_Hz, known_Hz)};
}

}  // namespace rvbench::analysis::examples
