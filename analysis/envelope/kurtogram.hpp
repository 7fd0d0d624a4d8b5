#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace rvbench::analysis {

struct KurtogramOptions {
  int levels = 7;                  ///< at most; fewer if a band would keep less than 64 samples
  double least_width_Hz = 0;       ///< of the best band: what swings faster is not held by less
  double false_alarm_rate = 0.01;  ///< of the whole kurtogram
};

/// Equal bands side by side, from 0 to half the rate.
struct KurtogramLevel {
  double level = 0;          ///< 0, 1, 1.58, 2, 2.58, ...: log2 of the number of bands
  double width_Hz = 0;       ///< of each
  Eigen::VectorXd kurtosis;  ///< of each, 0 for Gaussian noise
  Eigen::VectorXd p_value;   ///< that Gaussian noise of the band's spectrum shows it, for one band
};

struct KurtogramBand {
  double from_Hz = 0;
  double to_Hz = 0;
  double kurtosis = 0;
  double p_value = 1;  ///< for all bands searched

  double centre_Hz() const { return 0.5 * (from_Hz + to_Hz); }
  double width_Hz() const { return to_Hz - from_Hz; }
};

struct Kurtogram {
  std::vector<KurtogramLevel> levels;  ///< widest bands first

  /// The highest kurtosis of those bands that Gaussian noise would show, in any band, as rarely as
  /// the false-alarm rate; empty if there is none.
  std::optional<KurtogramBand> best;
};

/// Fast kurtogram: in which band a signal comes in strikes.
///
/// The positive lines of the spectrum are parted into 1, 2, 3, 4, 6, 8, ... bands (the 1/3-binary
/// tree), each of which is brought down to as many complex samples as it has lines: of white noise
/// they are independent and Gaussian, so that the kurtosis has a known distribution. In coloured
/// noise it is that of fewer samples, by the measured correlation.
///
/// Shape   N >= 256 samples, of which the last few may be left out so that the bands are equal
/// Units   Hz; kurtosis without
/// Limits  a strike that comes once counts like many; a tone takes significance from its band, as
///         does a train of strikes that repeats to a fraction of the carrier's period: it could be
///         noise of one period, repeated. 5 % of the record at either end, faded in and out, do not
///         count: so a strong tone that the record cuts off is no strike.
/// Errors  throws std::invalid_argument: N < 256, sample not finite, rate not positive, levels < 1,
///         false_alarm_rate not in (0, 1)
/// Source  Antoni, Mech. Syst. Signal Process. 21(1), 108-124 (2007)
Kurtogram fast_kurtogram(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_Hz,
                         const KurtogramOptions& options = {});

}  // namespace rvbench::analysis
