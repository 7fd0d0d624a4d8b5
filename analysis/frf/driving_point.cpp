#include "analysis/frf/driving_point.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/frf/motion.hpp"
#include "analysis/frf/signed_axis.hpp"

namespace rvbench::analysis {

namespace {

constexpr double deciding_share = 0.9;

// Whether the imaginary part changes from below to above 0 between two frequencies.
bool rises_through_zero(const FrequencyResponse& mobility, double sign, double from_Hz,
                        double to_Hz) {
  bool was_below = false;
  for (Eigen::Index k = 0; k < mobility.values.size(); ++k) {
    const double f_Hz = mobility.frequency_Hz(k);
    if (!(f_Hz > from_Hz && f_Hz < to_Hz)) continue;
    const double imaginary = sign * mobility.values[k].imag();
    if (was_below && imaginary > 0) return true;
    was_below = was_below || imaginary < 0;
  }
  return false;
}

}  // namespace

std::optional<DrivingPoint> check_driving_point(const FrequencyResponse& response,
                                                const FrfBand& band,
                                                const std::vector<double>& resonances_Hz) {
  const double sense = same_axis(response.response, response.excitation);
  const auto mobility = as_motion(response, Motion::velocity);
  if (sense == 0 || !mobility) return std::nullopt;
  double positive = 0, all = 0;
  for (Eigen::Index k = 0; k < mobility->values.size(); ++k) {
    const double f_Hz = mobility->frequency_Hz(k);
    const double real = sense * mobility->values[k].real();
    if (f_Hz <= 0 || f_Hz < band.from_Hz || f_Hz > band.to_Hz || !std::isfinite(real)) continue;
    positive += std::max(real, 0.0);
    all += std::abs(real);
  }
  if (!(all > 0)) return std::nullopt;

  DrivingPoint point;
  point.positive_share = positive / all;
  if (point.positive_share >= deciding_share) point.word = DrivingPointWord::sound;
  if (point.positive_share <= 1 - deciding_share) point.word = DrivingPointWord::reversed;
  const double sign = point.word == DrivingPointWord::reversed ? -sense : sense;
  for (std::size_t i = 0; i + 1 < resonances_Hz.size(); ++i) {
    const double from_Hz = resonances_Hz[i], to_Hz = resonances_Hz[i + 1];
    if (from_Hz < band.from_Hz || to_Hz > band.to_Hz) continue;
    if (!rises_through_zero(*mobility, sign, from_Hz, to_Hz)) {
      point.without_antiresonance.emplace_back(from_Hz, to_Hz);
    }
  }
  return point;
}

}  // namespace rvbench::analysis
