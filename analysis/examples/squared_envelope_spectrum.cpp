#include "analysis/envelope/squared_envelope_spectrum.hpp"

#include <cmath>

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double shown_Hz = 280;

Eigen::VectorXd thresholds(const TestedSpectrum& found) {
  const double rate = found.rate_of_one_line(1e-3);
  const auto last = static_cast<Eigen::Index>(shown_Hz / found.spectrum.resolution);
  Eigen::VectorXd all = Eigen::VectorXd::Constant(last + 1, std::nan(""));
  for (Eigen::Index line = found.first; line <= last; ++line) {
    all[line] = found.threshold(line, rate);
  }
  return all;
}

Panel drawn(const std::string& title, const TestedSpectrum& found) {
  const double step = found.spectrum.resolution;
  const auto last = static_cast<Eigen::Index>(shown_Hz / step);
  return {title,
          {"frequency [Hz]", 0, shown_Hz},
          {"depth", 0, 1.5},
          {{"squared envelope", 0, step, found.spectrum.amplitude.head(last + 1)},
           {"noise, once in 1000 spectra", 0, step, thresholds(found)}},
          {{83, "83"}, {166, "166"}, {249, "249"}}};
}

}  // namespace

Example squared_envelope_spectrum_example() {
  //! [page]
  const Eigen::VectorXd strikes =
      struck({.every_s = 1.0 / 83, .resonance_Hz = 2900, .decay_s = 1.5e-3}, 24000, 1);
  const Eigen::VectorXd x = strikes + 1.5 * rms(strikes) * noise(24000, 2);

  const TestedSpectrum found = squared_envelope_spectrum(x, 8000, 2600, 3200);
  const LineEvidence at_83 = evidence_near(found, 83, 1, 1e-3);
  const LineEvidence at_61 = evidence_near(found, 61, 1, 1e-3);
  const TestedSpectrum beside = squared_envelope_spectrum(x, 8000, 600, 1200);
  //! [page]
  return {"squared_envelope_spectrum",
          "Squared envelope spectrum",
          "The same strikes as in the kurtogram's example, 83 a second. In the band around the "
          "resonance the power comes and goes with them; each line is tested against the noise "
          "around it. In a band that the strikes do not reach, nothing stands out.",
          {"envelope/squared_envelope_spectrum.hpp", "envelope/tested_spectrum.hpp"},
          {{"line near 83 Hz [Hz]", "83", rounded(at_83.frequency, 1)},
           {"its depth", "–", rounded(at_83.amplitude, 2)},
           {"its p-value", "–", p_value_text(at_83.p_value)},
           {"p-value near 61 Hz, where nothing is", "–", p_value_text(at_61.p_value)},
           {"lines that noise shows once in 1000 spectra, around the resonance", "–",
            std::to_string(found.significant(1e-3).size())},
           {"the same in a band beside", "0", std::to_string(beside.significant(1e-3).size())}},
          {drawn("Band from 2600 to 3200 Hz", found), drawn("Band from 600 to 1200 Hz", beside)}};
}

}  // namespace rvbench::analysis::examples
