#include "analysis/emd/hilbert_spectrum.hpp"

#include "analysis/emd/emd.hpp"
#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/hilbert.hpp"
#include "analysis/spectrum.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double rate_Hz = 1000;

// Of the bins from one frequency to another, 1 Hz each.
double power_between(const MarginalSpectrum& spectrum, Eigen::Index from, Eigen::Index to) {
  return spectrum.power.segment(from, to - from).sum();
}

Panel frequencies(const Eigen::VectorXd& found_Hz, const Eigen::VectorXd& true_Hz) {
  const auto tenth = Eigen::seqN(0, found_Hz.size() / 10, 10);
  return {"Instantaneous frequency of IMF 2",
          {"time [s]", 0, 4},
          {"frequency [Hz]", 0, 35},
          {{"found", 0, 0.01, found_Hz(tenth)}, {"sweep", 0, 0.01, true_Hz(tenth)}}};
}

Panel powers(const Eigen::VectorXd& marginal, const Eigen::VectorXd& fourier) {
  return {"Power over frequency",
          {"frequency [Hz]", 0, 120},
          {"(m/s²)²", 0, 0.6},
          {{"marginal Hilbert", 0.5, 1, marginal}, {"Fourier lines", 0, 0.25, fourier}}};
}

}  // namespace

Example hilbert_spectrum_example() {
  //! [page]
  const Eigen::ArrayXd t_s = times_s(4000, 1000);
  const Eigen::ArrayXd sweep_Hz = 10 + 2.5 * t_s;
  const Eigen::VectorXd sweep = wave(10 * t_s + 1.25 * t_s.square());
  const Eigen::VectorXd swinging = (1 + 0.5 * wave(4 * t_s).array()) * wave(80.5 * t_s).array();
  const Eigen::VectorXd x = swinging + sweep;

  const Emd modes = emd(x, {.imfs = 2});
  const Eigen::VectorXd found_Hz = instantaneous_frequency_Hz(modes.imfs.col(1), 1000);
  const MarginalSpectrum marginal = marginal_spectrum(modes.imfs, 1000, 500);
  const Spectrum fourier = amplitude_spectrum(x, 1000, Window::rectangular);
  //! [page]
  const Eigen::VectorXd off = found_Hz - sweep_Hz.matrix();
  const Eigen::VectorXd lines = 0.5 * fourier.amplitude.array().square();
  return {"hilbert_spectrum",
          "Hilbert spectrum",
          "A tone at 80.5 Hz whose amplitude swings by half at 4 Hz, and a sweep from 10 to 20 Hz "
          "in 4 s. Fourier lines stand for what is steady: the swing becomes two lines beside the "
          "tone, the sweep a plateau. The instantaneous frequency of an IMF follows the sweep, and "
          "the marginal Hilbert spectrum leaves the power of the tone in its own bin.",
          {"emd/hilbert_spectrum.hpp", "hilbert.hpp"},
          {{"power within 2 Hz of the tone, Hilbert [(m/s²)²]", "0.5625",
            rounded(power_between(marginal, 79, 82), 3)},
           {"power within 2 Hz of the tone, Fourier [(m/s²)²]", "0.5",
            rounded(lines.segment(4 * 79, 13).sum(), 3)},
           {"power from 8 to 22 Hz, Hilbert [(m/s²)²]", "0.5",
            rounded(power_between(marginal, 8, 22), 3)},
           {"power that has no frequency [(m/s²)²]", "0", rounded(marginal.unplaced, 3)},
           {"frequency of the sweep, rms error from 0.5 to 3.5 s [Hz]", "0",
            rounded(rms(off.segment(500, 3000)), 2)}},
          {Panel{"The signal",
                 {"time [s]", 0, 0.5},
                 {"m/s²", -2.7, 2.7},
                 {{"signal", 0, 1 / rate_Hz, x}}},
           frequencies(found_Hz, sweep_Hz), powers(marginal.power, lines)}};
}

}  // namespace rvbench::analysis::examples
