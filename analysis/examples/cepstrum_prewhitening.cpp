#include "analysis/envelope/squared_envelope_spectrum.hpp"
#include "analysis/envelope/whitening.hpp"
#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"
#include "analysis/statistics.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double shown_Hz = 300;

Panel drawn(const std::string& title, const TestedSpectrum& found, double most) {
  const double step = found.spectrum.resolution;
  const auto last = static_cast<Eigen::Index>(shown_Hz / step);
  return {title,
          {"frequency [Hz]", 0, shown_Hz},
          {"depth", 0, most},
          {{"", 0, step, found.spectrum.amplitude.head(last + 1)}},
          {{60, "60: mesh lines beat"}, {83, "83: strikes"}, {166, "166: strikes"}}};
}

}  // namespace

Example cepstrum_prewhitening_example() {
  //! [page]
  // Mesh lines 60 Hz apart, 40 times as strong as the strikes; noise half as strong as these.
  const Eigen::ArrayXd t_s = times_s(24000, 8000);
  const Eigen::VectorXd mesh = wave(600 * t_s) + 0.7 * wave(660 * t_s) + 0.5 * wave(1200 * t_s);
  const Eigen::VectorXd strikes =
      struck({.every_s = 1.0 / 83, .resonance_Hz = 2900, .decay_s = 1.5e-3}, 24000, 1);
  const Eigen::VectorXd x =
      40 * rms(strikes) / rms(mesh) * mesh + strikes + 0.5 * rms(strikes) * noise(24000, 2);

  const Eigen::VectorXd white = cepstrum_prewhitened(x);
  const TestedSpectrum before = squared_envelope_spectrum(x, 8000, 0, 4000);
  const TestedSpectrum after = squared_envelope_spectrum(white, 8000, 0, 4000);
  //! [page]
  return {
      "cepstrum_prewhitening",
      "Cepstrum pre-whitening",
      "Strikes, 83 a second, under mesh lines 40 times as strong. The envelope of all bands "
      "swings as the mesh lines beat, 60 times a second. Once every spectral line has the same "
      "height, a tone is one line among thousands, and what is left to swing are the strikes: "
      "no band needs to be chosen.",
      {"envelope/whitening.hpp", "envelope/squared_envelope_spectrum.hpp"},
      {{"kurtosis of the signal", "–", rounded(kurtosis(x), 1)},
       {"kurtosis of the whitened signal", "–", rounded(kurtosis(white), 1)},
       {"p-value near 83 Hz, before", "–",
        p_value_text(evidence_near(before, 83, 1, 1e-3).p_value)},
       {"p-value near 83 Hz, after", "–", p_value_text(evidence_near(after, 83, 1, 1e-3).p_value)},
       {"depth at 60 Hz, before", "–", rounded(evidence_near(before, 60, 0.5, 1e-3).amplitude, 2)},
       {"depth at 60 Hz, after", "0", rounded(evidence_near(after, 60, 0.5, 1e-3).amplitude, 2)}},
      {Panel{"The signal, before and after, over its rms",
             {"time [s]", 0.5, 0.6},
             {"rms", -7, 7},
             {{"whitened", 0, 1 / 8000.0, white}, {"signal", 0, 1 / 8000.0, x / rms(x)}}},
       drawn("Squared envelope of all bands, before", before, 1),
       drawn("Squared envelope of all bands, after", after, 1)}};
}

}  // namespace rvbench::analysis::examples
