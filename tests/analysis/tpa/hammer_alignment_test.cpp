#include "analysis/tpa/hammer_alignment.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/tpa/random_matrices.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

constexpr Index points = 3, columns = 9, rows = 12, lines = 120;

/// Three points hit in three directions, with a sensor at each, and three sensors elsewhere; eight
/// modes by chance.
FrfMatrix reciprocal(unsigned seed) {
  FrfMatrix frfs;
  for (Index i = 0; i < rows; ++i) {
    const DegreeOfFreedom place{std::string(1, char('A' + i / 3)), std::string("+") + "XYZ"[i % 3]};
    frfs.responses.push_back(place);
    if (i < columns) frfs.excitations.push_back(place);
  }
  frfs.first_Hz = 10;
  frfs.step_Hz = 1;
  frfs.values = LineMatrices(rows, columns, lines);
  for (unsigned mode = 0; mode < 8; ++mode) {
    const Eigen::VectorXcd shape =
        test::complex_noise(rows, 1, 100 * seed + mode).real().cast<std::complex<double>>();
    for (Index line = 0; line < lines; ++line) {
      const double r = frfs.frequency_Hz(line) / (20 + 13 * mode);
      frfs.values[line] += shape * shape.head(columns).transpose() *
                           (-r * r / std::complex<double>(1 - r * r, 0.05 * r));
    }
  }
  return frfs;
}

// Within each point, of no mean strength.
Eigen::MatrixXd blows(double size, unsigned seed) {
  Eigen::MatrixXd mixing = Eigen::MatrixXd::Zero(columns, columns);
  for (Index point = 0; point < points; ++point) {
    mixing.block<3, 3>(3 * point, 3 * point) =
        size * test::complex_noise(3, 3, seed + unsigned(point)).real();
  }
  mixing.diagonal().array() -= mixing.trace() / columns;
  return mixing;
}

FrfMatrix hit(FrfMatrix frfs, const Eigen::MatrixXd& mixing) {
  const Eigen::MatrixXcd all =
      (Eigen::MatrixXd::Identity(columns, columns) + mixing).cast<std::complex<double>>();
  for (Index line = 0; line < lines; ++line) {
    frfs.values[line] = Eigen::MatrixXcd(frfs.values[line]) * all;
  }
  return frfs;
}

double off(const FrfMatrix& a, const FrfMatrix& b) {
  return (a.values.values - b.values.values).norm() / b.values.values.norm();
}

}  // namespace

TEST_CASE("reciprocity tells how blows were turned, and they are set right", "[tpa]") {
  const unsigned seed = GENERATE(1u, 2u, 3u);
  const FrfMatrix exact = reciprocal(seed);
  const Eigen::MatrixXd mixing = blows(0.03, seed);
  const FrfMatrix measured = hit(exact, mixing);
  const HammerAlignment alignment = hammer_alignment(measured);
  REQUIRE(alignment.is_used);
  CHECK((alignment.mixing - mixing).cwiseAbs().maxCoeff() < 1e-3);
  CHECK(alignment.asymmetry_after < 0.01 * alignment.asymmetry_before);
  CHECK(off(measured, exact) > 0.02);
  CHECK(off(aligned_frfs(measured, alignment), exact) < 1e-3);
  Eigen::MatrixXd turns = mixing;
  turns.diagonal().setZero();
  CHECK(alignment.largest_turn_rad() == Approx(turns.cwiseAbs().maxCoeff()).epsilon(0.05));
}

TEST_CASE("noise of the FRFs does not turn blows that were not", "[tpa][null]") {
  FrfMatrix noisy = reciprocal(4);
  const double rms = noisy.values.values.norm() / std::sqrt(double(noisy.values.values.size()));
  noisy.values.values += 0.02 * rms * test::complex_noise(noisy.values.values.size(), 1, 9);
  noisy.noise = Eigen::MatrixXd::Constant(rows * columns, lines, std::pow(0.02 * rms, 2));
  // 36 pairs at 120 lines, of two parts each, of which every 27th part is an unknown's: noise of
  // 2 % is told apart to 0.02·√(2·27/8640), and where a direction is heard little, to a few times
  // that.
  CHECK(hammer_alignment(noisy).mixing.cwiseAbs().maxCoeff() < 0.01);
  const FrfMatrix exact = reciprocal(5);
  const HammerAlignment none = hammer_alignment(exact);
  CHECK(none.mixing.cwiseAbs().maxCoeff() < 1e-9);
  CHECK(off(aligned_frfs(exact, none), exact) < 1e-9);
}

TEST_CASE("blows that would be off by too much are left to whoever reads the doubts", "[tpa]") {
  const FrfMatrix measured = hit(reciprocal(6), blows(0.4, 6));
  const HammerAlignment alignment = hammer_alignment(measured);
  CHECK_FALSE(alignment.is_used);
  CHECK(alignment.asymmetry_before > 0.1);
  CHECK(off(aligned_frfs(measured, alignment), measured) == 0);
}

TEST_CASE("without sensors where it is hit, reciprocity tells nothing", "[tpa]") {
  FrfMatrix frfs = reciprocal(7);
  for (DegreeOfFreedom& place : frfs.responses) place.point += " passive";
  const HammerAlignment alignment = hammer_alignment(frfs);
  CHECK_FALSE(alignment.is_used);
  CHECK(alignment.largest_turn_rad() == 0);
}

TEST_CASE("each draw is aligned for itself", "[tpa]") {
  const FrfMatrix exact = reciprocal(8);
  unsigned turn = 0;
  const FrfDraw draw =
      aligned_draws([&](std::mt19937_64&) { return hit(exact, blows(0.03, ++turn)); });
  std::mt19937_64 engine(1);
  for (int i = 0; i < 3; ++i) CHECK(off(draw(engine), exact) < 1e-3);
}
