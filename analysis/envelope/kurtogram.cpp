#include "analysis/envelope/kurtogram.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/envelope/noise_kurtosis.hpp"
#include "analysis/fft.hpp"
#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index fewest_samples = 64;  // of a band
constexpr double faded = 0.05;               // of the record, at either end

// 1, 2, 3, 4, 6, 8, ... up to 2^levels.
std::vector<Eigen::Index> bands_by_level(int levels) {
  std::vector<Eigen::Index> bands{1};
  for (Eigen::Index halves = 2; halves <= Eigen::Index{1} << levels; halves *= 2) {
    if (halves > 2) bands.push_back(halves / 4 * 3);
    bands.push_back(halves);
  }
  return bands;
}

int levels_of(Eigen::Index size, int wanted) {
  int levels = 1;
  while (levels < wanted && size / 2 >= fewest_samples << (levels + 1)) ++levels;
  return levels;
}

Eigen::VectorXd faded_ends(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Eigen::VectorXd result = x.array() - x.mean();
  const auto length = static_cast<Eigen::Index>(faded * double(x.size()));
  for (Eigen::Index i = 0; i < length; ++i) {
    // So smooth that a tone does not strike where it sets in.
    const double part = 0.5 - 0.5 * std::cos(std::numbers::pi * (double(i) + 0.5) / double(length));
    const double gain = 0.5 - 0.5 * std::cos(std::numbers::pi * part);
    result[i] *= gain;
    result[x.size() - 1 - i] *= gain;
  }
  return result;
}

KurtogramLevel level_of(const Eigen::VectorXcd& lines, double rate_Hz, Eigen::Index bands) {
  KurtogramLevel level{std::log2(double(bands)), rate_Hz / 2 / double(bands),
                       Eigen::VectorXd(bands), Eigen::VectorXd(bands)};
  const Eigen::Index size = lines.size() / bands;
  const auto end = static_cast<Eigen::Index>(std::ceil(faded * double(size)));
  for (Eigen::Index band = 0; band < bands; ++band) {
    const auto own = lines.segment(band * size, size);
    const Eigen::VectorXcd z = inverse_complex_fft(own);
    const Eigen::Index kept = size - 2 * end;
    level.kurtosis[band] = complex_kurtosis(z.segment(end, kept));
    const double samples = independent_samples(own.cwiseAbs2(), double(kept));
    level.p_value[band] = noise_kurtosis_p_value(level.kurtosis[band], std::max(samples, 2.0));
  }
  return level;
}

std::optional<KurtogramBand> best_of(const std::vector<KurtogramLevel>& levels,
                                     const KurtogramOptions& options) {
  double searched = 0;
  for (const KurtogramLevel& level : levels) {
    if (level.width_Hz >= options.least_width_Hz) searched += double(level.kurtosis.size());
  }
  std::optional<KurtogramBand> best;
  for (const KurtogramLevel& level : levels) {
    if (level.width_Hz < options.least_width_Hz) continue;
    for (Eigen::Index band = 0; band < level.kurtosis.size(); ++band) {
      const double p = std::min(1.0, searched * level.p_value[band]);
      if (p > options.false_alarm_rate || level.kurtosis[band] <= 0) continue;
      if (best && level.kurtosis[band] <= best->kurtosis) continue;
      best = KurtogramBand{double(band) * level.width_Hz, double(band + 1) * level.width_Hz,
                           level.kurtosis[band], p};
    }
  }
  return best;
}

}  // namespace

Kurtogram fast_kurtogram(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                         const KurtogramOptions& options) {
  constexpr Require require{"fast_kurtogram"};
  require(x.size() >= 4 * fewest_samples, "needs at least 256 samples");
  require(x.allFinite(), "sample not finite");
  require(options.levels >= 1, "levels must be at least 1");
  require(options.false_alarm_rate > 0 && options.false_alarm_rate < 1,
          "false_alarm_rate must be within 0 and 1");
  require_positive(rate_Hz, "fast_kurtogram", "rate_Hz");

  const int levels = levels_of(x.size(), options.levels);
  const Eigen::Index equal_parts = Eigen::Index{3} << (levels + 1);
  const Eigen::Index size = x.size() / equal_parts * equal_parts;
  Eigen::VectorXcd lines = fft(faded_ends(x.head(size)));
  lines[0] = 0;
  Kurtogram kurtogram;
  for (const Eigen::Index bands : bands_by_level(levels)) {
    kurtogram.levels.push_back(level_of(lines.head(size / 2), rate_Hz, bands));
  }
  kurtogram.best = best_of(kurtogram.levels, options);
  return kurtogram;
}

}  // namespace rvbench::analysis
