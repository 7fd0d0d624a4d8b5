#include "analysis/envelope/kurtogram.hpp"

#include "analysis/examples/examples.hpp"
#include "analysis/examples/signals.hpp"

namespace rvbench::analysis::examples {
namespace {

Map drawn(const Kurtogram& found, double rate_Hz) {
  Map picture{"Kurtosis of each band (white: 0, dark: the highest)",
              {"frequency [Hz]", 0, rate_Hz / 2},
              "level: log2 of the number of bands",
              found.best->kurtosis,
              {}};
  for (auto level = found.levels.rbegin(); level != found.levels.rend(); ++level) {
    picture.rows.push_back({rounded(level->level, 1), level->kurtosis.cwiseMax(0)});
  }
  return picture;
}

}  // namespace

Example kurtogram_example() {
  //! [page]
  // Struck 83 times a second, a resonance at 2.9 kHz rings with a decay of 1.5 ms.
  const Eigen::VectorXd strikes =
      struck({.every_s = 1.0 / 83, .resonance_Hz = 2900, .decay_s = 1.5e-3}, 24000, 1);
  const Eigen::VectorXd x = strikes + 1.5 * rms(strikes) * noise(24000, 2);

  const Kurtogram found = fast_kurtogram(x, 8000, {.levels = 6});
  const KurtogramBand band = *found.best;

  const Kurtogram silence = fast_kurtogram(noise(24000, 2), 8000, {.levels = 6});
  //! [page]
  const bool is_within = band.from_Hz < 2900 && band.to_Hz > 2900;
  return {"kurtogram",
          "Fast kurtogram",
          "A resonance at 2.9 kHz is struck 83 times a second, under noise of 1.5 times its rms: "
          "the strikes are hardly to be seen. The kurtogram finds the band in which the signal "
          "comes in strikes, and says how rarely noise alone shows one; in the noise alone it "
          "finds none.",
          {"envelope/kurtogram.hpp"},
          {{"band that was found [Hz]", "around 2900",
            rounded(band.from_Hz, 0) + " to " + rounded(band.to_Hz, 0)},
           {"it holds the resonance", "yes", is_within ? "yes" : "no"},
           {"its kurtosis", "–", rounded(band.kurtosis, 2)},
           {"p-value of all bands", "–", p_value_text(band.p_value)},
           {"bands found in noise alone", "0", silence.best ? "1" : "0"}},
          {Panel{"The signal, and the strikes in it",
                 {"time [s]", 0.5, 0.6},
                 {"m/s²", -1.5, 1.5},
                 {{"signal", 0, 1 / 8000.0, x}, {"strikes", 0, 1 / 8000.0, strikes}}},
           drawn(found, 8000)}};
}

}  // namespace rvbench::analysis::examples
