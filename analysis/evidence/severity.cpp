#include "analysis/evidence/severity.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t draws = 1999;
constexpr std::size_t outside = 50;  // 2.5 % of draws + 1, on either side

}  // namespace

Severity severity_of(const std::vector<const SignatureScore*>& scores) {
  if (scores.empty()) throw std::invalid_argument("severity_of: no scores");
  std::vector<double> depths;
  for (const SignatureScore* score : scores) depths.push_back(score->depth);

  std::mt19937_64 engine(20240607);
  std::uniform_int_distribution<std::size_t> any(0, scores.size() - 1);
  std::normal_distribution<double> noise;
  std::vector<double> medians;
  for (std::size_t draw = 0; draw < draws; ++draw) {
    std::vector<double> drawn;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      const SignatureScore& score = *scores[any(engine)];
      // The scatter between points holds their noise already.
      const double deviation = scores.size() == 1 ? std::sqrt(score.depth2_variance) : 0;
      const double moved = score.depth * score.depth + deviation * noise(engine);
      drawn.push_back(std::sqrt(std::max(moved, 0.0)));
    }
    medians.push_back(median(std::move(drawn)));
  }
  std::sort(medians.begin(), medians.end());
  return {median(std::move(depths)), medians[outside - 1], medians[draws - outside]};
}

}  // namespace rvbench::analysis
