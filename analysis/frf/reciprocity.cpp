#include "analysis/frf/reciprocity.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/frf/signed_axis.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

Reciprocity reciprocity(const FrequencyResponse& a, const FrequencyResponse& b,
                        const FrfBand& band) {
  constexpr Require require{"reciprocity"};
  require(a.first_Hz == b.first_Hz && a.step_Hz == b.step_Hz && a.step_Hz > 0 &&
              a.values.size() == b.values.size(),
          b.source + ": its lines are not those of " + a.source);
  const auto line_of = [&](double f_Hz) {
    const double line = std::clamp((f_Hz - a.first_Hz) / a.step_Hz, -1.0, double(a.values.size()));
    return line;
  };
  const auto from = Eigen::Index(std::max(std::ceil(line_of(band.from_Hz)), 0.0));
  const auto to = std::min(Eigen::Index(std::floor(line_of(band.to_Hz))), a.values.size() - 1);
  Reciprocity result;
  result.score.setZero(std::max<Eigen::Index>(to - from + 1, 0));
  double common = 0, power = 0;
  for (Eigen::Index k = from; k <= to; ++k) {
    const double product = 2 * (a.values[k] * std::conj(b.values[k])).real();
    const double sum = std::norm(a.values[k]) + std::norm(b.values[k]);
    if (!(sum > 0) || !std::isfinite(product) || !std::isfinite(sum)) continue;
    result.score[k - from] = product / sum;
    common += product;
    power += sum;
  }
  if (power > 0) result.band_score = common / power;
  return result;
}

std::vector<ReciprocalPair> reciprocal_pairs(const std::vector<FrequencyResponse>& responses,
                                             const FrfBand& band) {
  std::vector<ReciprocalPair> pairs;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    if (same_axis(responses[i].response, responses[i].excitation) != 0) continue;
    for (std::size_t j = i + 1; j < responses.size(); ++j) {
      const double sense = same_axis(responses[i].response, responses[j].excitation) *
                           same_axis(responses[i].excitation, responses[j].response);
      if (sense == 0) continue;
      ReciprocalPair pair{i, j, sense, reciprocity(responses[i], responses[j], band)};
      pair.reciprocity.score *= sense;
      pair.reciprocity.band_score *= sense;
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
}

}  // namespace rvbench::analysis
