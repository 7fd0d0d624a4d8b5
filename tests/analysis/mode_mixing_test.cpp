#include "analysis/emd/mode_mixing.hpp"

#include <catch2/catch.hpp>

#include "analysis/emd/emd.hpp"
#include "analysis/emd/ensemble_emd.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::orthogonality_index;
using analysis::spectral_overlap;

namespace {

Eigen::MatrixXd side_by_side(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::MatrixXd both(a.size(), 2);
  both << a, b;
  return both;
}

}  // namespace

TEST_CASE("tones of different lines do not mix, the same tone twice does", "[analysis][emd][law]") {
  const Eigen::VectorXd slow = test::tone(10, 1000, 1000), fast = test::tone(100, 1000, 1000);
  CHECK(orthogonality_index(side_by_side(fast, slow)) < 1e-12);
  CHECK(spectral_overlap(side_by_side(fast, slow))[0] < 1e-12);
  // x and x: 2 x² of products over (2 x)².
  CHECK(orthogonality_index(side_by_side(slow, slow)) == Approx(0.5));
  CHECK(spectral_overlap(side_by_side(slow, slow))[0] == Approx(1));
  CHECK(spectral_overlap(side_by_side(slow, 0.5 * slow))[0] == Approx(1));
  // A tenth of the fast one's amplitude beside the slow one: a hundredth of its power is shared, of
  // 1.01 in all.
  CHECK(spectral_overlap(side_by_side(fast, slow + 0.1 * fast))[0] == Approx(0.01).epsilon(1e-9));
}

TEST_CASE("the IMFs of white noise overlap as a filter bank does", "[analysis][emd]") {
  const Eigen::MatrixXd imfs = analysis::emd(test::white_noise(40000, 8)).imfs.leftCols(6);
  const Eigen::VectorXd overlap = spectral_overlap(imfs);
  CHECK(overlap.minCoeff() > 0.15);
  CHECK(overlap.maxCoeff() < 0.5);
  CHECK(orthogonality_index(imfs) < 0.2);
}

TEST_CASE("what comes and goes mixes modes, an ensemble does so less", "[analysis][emd]") {
  Eigen::VectorXd x = test::tone(10, 4000, 1000);
  const Eigen::VectorXd fast = 0.2 * test::tone(120, 4000, 1000);
  for (const Eigen::Index from : {800, 2000, 3200}) x.segment(from, 300) += fast.segment(from, 300);
  const double plain = spectral_overlap(analysis::emd(x).imfs.leftCols(2))[0];
  const auto modes = analysis::ceemdan(x, {.members = 40});
  CHECK(plain > 0.3);
  CHECK(spectral_overlap(modes.imfs.leftCols(2))[0] < plain);
}

TEST_CASE("of nothing there is no mixing", "[analysis][emd]") {
  CHECK(orthogonality_index(Eigen::MatrixXd(100, 0)) == 0);
  CHECK(spectral_overlap(Eigen::MatrixXd(100, 0)).size() == 0);
  CHECK(orthogonality_index(Eigen::MatrixXd::Zero(100, 2)) == 0);
  CHECK(std::isnan(spectral_overlap(Eigen::MatrixXd::Zero(100, 2))[0]));
}
