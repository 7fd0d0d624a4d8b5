#include "analysis/envelope/spectral_coherence.hpp"

#include <cmath>

#include "analysis/envelope/whitening.hpp"
#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"

namespace rvbench::analysis::examples {
namespace {

constexpr double shown_Hz = 300;
constexpr Eigen::Index columns = 100;

// The highest line of each stretch: what a cell of the map shows.
Map drawn(const SpectralCoherence& found) {
  Map picture{"Squared coherence (white: 0, dark: 0.2 and more)",
              {"cyclic frequency [Hz]", 0, shown_Hz},
              "frequency [Hz]",
              0.2,
              {}};
  const auto per_cell = static_cast<Eigen::Index>(shown_Hz / found.resolution) / columns;
  for (Eigen::Index band = 0; band < found.squared.rows(); ++band) {
    Eigen::VectorXd cells = Eigen::VectorXd::Zero(columns);
    for (Eigen::Index c = 1; c < columns; ++c) {
      cells[c] = found.squared.row(band).segment(c * per_cell, per_cell).maxCoeff();
    }
    const double middle_Hz = found.first + (double(band) + 0.5) * found.width;
    picture.rows.push_back({band % 5 == 2 ? rounded(middle_Hz, 0) : "", cells});
  }
  return picture;
}

Panel spectrum(const std::string& title, const TestedSpectrum& found) {
  const double step = found.spectrum.resolution, rate = found.rate_of_one_line(1e-3);
  const auto last = static_cast<Eigen::Index>(shown_Hz / step);
  Eigen::VectorXd threshold = Eigen::VectorXd::Constant(last, std::nan(""));
  for (Eigen::Index k = found.first; k < last; ++k) threshold[k] = found.threshold(k, rate);
  return {title,
          {"cyclic frequency [Hz]", 0, shown_Hz},
          {"rms of |γ|", 0, 0.6},
          {{"spectrum", 0, step, found.spectrum.amplitude.head(last)},
           {"noise, once in 1000 spectra", 0, step, threshold}}};
}

}  // namespace

Example spectral_coherence_example() {
  //! [page]
  // Two parts, each with its own resonance: 83 strikes a second at 2.9 kHz, 47 at 1.2 kHz.
  const Eigen::VectorXd outer =
      struck({.every_s = 1.0 / 83, .resonance_Hz = 2900, .decay_s = 1.5e-3}, 24000, 1);
  const Eigen::VectorXd inner =
      struck({.every_s = 1.0 / 47, .resonance_Hz = 1200, .decay_s = 1.5e-3}, 24000, 2);
  const Eigen::VectorXd x = outer + inner + 0.35 * noise(24000, 3);

  const SpectralCoherence found =
      spectral_coherence(floor_whitened(x), 8000, {.highest = 400, .bands = 30});
  const TestedSpectrum all = enhanced_envelope_spectrum(found);
  const TestedSpectrum high = improved_envelope_spectrum(found, 2500, 3300);
  const LineEvidence at_47 = evidence_near(all, 47, 1, 1e-3);
  const LineEvidence at_83 = evidence_near(all, 83, 1, 1e-3);
  const LineEvidence high_at_47 = evidence_near(high, 47, 1, 1e-3);
  const LineEvidence high_at_83 = evidence_near(high, 83, 1, 1e-3);
  //! [page]
  return {"spectral_coherence",
          "Spectral coherence, enhanced and improved envelope spectrum",
          "Two parts strike, each its own resonance, in noise. The coherence tells for each band "
          "of frequencies how deeply it swings at each cyclic frequency: which resonance answers "
          "to which part. Its mean over all bands finds both parts, that over the bands of one "
          "resonance only the part that strikes it.",
          {"envelope/spectral_coherence.hpp", "envelope/whitening.hpp"},
          {{"all bands: line near 47 Hz [Hz]", "47", rounded(at_47.frequency, 1)},
           {"all bands: its p-value", "–", p_value_text(at_47.p_value)},
           {"all bands: line near 83 Hz [Hz]", "83", rounded(at_83.frequency, 1)},
           {"all bands: its p-value", "–", p_value_text(at_83.p_value)},
           {"2.5 to 3.3 kHz: p-value near 47 Hz, which is elsewhere", "–",
            p_value_text(high_at_47.p_value)},
           {"2.5 to 3.3 kHz: p-value near 83 Hz", "–", p_value_text(high_at_83.p_value)}},
          {drawn(found), spectrum("Enhanced envelope spectrum: all bands", all),
           spectrum("Improved envelope spectrum: 2.5 to 3.3 kHz", high)}};
}

}  // namespace rvbench::analysis::examples
