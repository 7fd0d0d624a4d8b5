#include "analysis/emd/emd.hpp"
#include "analysis/envelope_spectra.hpp"
#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/hilbert.hpp"
#include "analysis/shaft_angle.hpp"
#include "analysis/spectrum.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double rate_Hz = 4960;

Eigen::VectorXd over_mean(const Eigen::VectorXd& amplitude, double mean) {
  return amplitude / mean;
}

Panel lines(const std::string& title, const Axis& x, double resolution,
            const Eigen::VectorXd& depth) {
  const auto shown = static_cast<Eigen::Index>(x.max / resolution);
  return {title, x, {"depth", 0, 0.35}, {{"depth", 0, resolution, depth.head(shown)}}};
}

}  // namespace

Example envelope_order_spectrum_example() {
  //! [page]
  // 484 turns at 30.25 rev/s, which wander by 2 %: four turns of the output of an RV-20E.
  const Eigen::ArrayXd t_s = times_s(79600, 4960);
  const Eigen::ArrayXd turns = 30.25 * t_s - 0.02 * 30.25 / 0.6 * (0.6 * t_s).cos();
  const Eigen::ArrayXd swing = 1 + 0.3 * wave(turns).array() + 0.15 * wave(2 * turns).array();
  const Eigen::VectorXd x = swing * wave(900 * t_s).array() + 0.05 * noise(79600, 1).array();
  const auto angle = *ShaftAngle::of_turns(turns, 0, 1 / 4960.0);

  const Emd modes = emd(x, {.imfs = 1});
  const EnvelopeSpectra found = envelope_spectra(modes.imfs.col(0), 4960, 0, angle, 121);
  const auto depth_at = [&](double order) {
    const auto line = std::lround(order / found.whole.resolution);
    return found.whole.amplitude[line] / found.mean;
  };
  //! [page]
  const Eigen::VectorXd power = envelope(modes.imfs.col(0));
  const Spectrum over_time = amplitude_spectrum(power, rate_Hz, Window::hann);
  return {"envelope_order_spectrum",
          "Envelope order spectrum",
          "What the article does to each IMF: envelope, sampled anew at even steps of the shaft's "
          "angle, spectrum. A resonance at 900 Hz is driven once per turn by 30 % and twice per "
          "turn by 15 %, while the speed wanders by 2 %. Over frequency both lines smear; over "
          "orders they stand where they belong, and read the depth of the modulation.",
          {"envelope_spectra.hpp", "hilbert.hpp", "shaft_angle.hpp"},
          {{"output turns that were used", "4", rounded(found.periods, 0)},
           {"depth at order 1", "0.300", rounded(depth_at(1), 3)},
           {"depth at order 2", "0.150", rounded(depth_at(2), 3)},
           {"depth at order 0.5", "0", rounded(depth_at(0.5), 3)}},
          {lines("Envelope spectrum over frequency", {"frequency [Hz]", 0, 90},
                 over_time.resolution, over_mean(over_time.amplitude, over_time.amplitude[0])),
           lines("Envelope spectrum over orders", {"order of the input shaft", 0, 3},
                 found.whole.resolution, over_mean(found.whole.amplitude, found.mean))}};
}

}  // namespace rvbench::analysis::examples
