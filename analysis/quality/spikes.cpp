#include "analysis/quality/spikes.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/smallest_step.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

constexpr Eigen::Index reach = 4;    // samples that one jump and the cubic next to it take
constexpr Eigen::Index nearby = 16;  // samples beyond, on either side, that must be calm
constexpr Eigen::Index margin = reach + nearby;
constexpr double calm = 10;          // times smaller
constexpr double rare = 8;           // rms: hardly ever in Gaussian noise
constexpr double fewest_steps = 20;  // below, the converter's steps are all that is seen

// How far each sample is off the cubic through two neighbours on either side; 0 at the ends.
Eigen::VectorXd off_the_cubic(const Eigen::Ref<const Eigen::VectorXd>& x) {
  Eigen::VectorXd r = Eigen::VectorXd::Zero(x.size());
  const Eigen::Index n = x.size() - 4;
  r.segment(2, n) =
      x.segment(2, n) - (4 * (x.segment(1, n) + x.segment(3, n)) - x.head(n) - x.tail(n)) / 6;
  return r;
}

// Takes what surrounds a sample, and the sample after it, to what is left beside the cubic through
// the surroundings: I − P of least squares.
Eigen::MatrixXd beside_cubic() {
  Eigen::VectorXd at(2 * nearby + 1);
  at << Eigen::VectorXd::LinSpaced(nearby, -margin, -reach - 1),
      Eigen::VectorXd::LinSpaced(nearby, reach + 1, margin), 0;
  Eigen::MatrixXd powers(at.size(), 4);
  for (Eigen::Index p = 0; p < 4; ++p) powers.col(p) = (at / margin).array().pow(double(p));
  const Eigen::MatrixXd around = powers.topRows(2 * nearby);
  const Eigen::MatrixXd fit =
      algebra::SymmetricFactors(algebra::gram(around)).solve(Eigen::MatrixXd(around.transpose()));
  Eigen::MatrixXd left = Eigen::MatrixXd::Identity(at.size(), at.size());
  left.leftCols(2 * nearby) -= algebra::product(powers, fit);
  return left;
}

bool stands_alone(const Eigen::Ref<const Eigen::VectorXd>& x, Eigen::Index i, double least) {
  static const Eigen::MatrixXd beside = beside_cubic();
  Eigen::VectorXd part(2 * nearby + 1);
  part << x.segment(i - margin, nearby), x.segment(i + reach + 1, nearby), x[i];
  const Eigen::VectorXd left = (beside * part).cwiseAbs();
  const double jump = left[2 * nearby];
  return jump >= least && jump >= calm * left.head(2 * nearby).maxCoeff();
}

}  // namespace

std::vector<Eigen::Index> find_spikes(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (!x.allFinite()) throw std::invalid_argument("find_spikes: sample not finite");
  if (x.size() <= 2 * margin) return {};
  const Eigen::VectorXd size = off_the_cubic(x).cwiseAbs();
  const double rms = std::sqrt(size.squaredNorm() / static_cast<double>(size.size()));
  const double least = fewest_steps * smallest_step(x);
  std::vector<Eigen::Index> spikes;
  for (Eigen::Index i = margin; i < size.size() - margin; ++i) {
    if (size[i] < rare * rms || size[i] < size.segment(i - reach, 2 * reach + 1).maxCoeff() ||
        !stands_alone(x, i, least)) {
      continue;
    }
    spikes.push_back(i);
    i += reach;
  }
  return spikes;
}

}  // namespace rvbench::analysis
