#include <catch2/catch.hpp>

#include "analysis/emd/emd.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Emd;
using analysis::emd;
using analysis::EmdOptions;

namespace {

// How many of the ends of windows of `length` are within `share` of the rms of their IMF beyond
// the samples marked unreliable, against the same stretch of the whole record.
struct Ends {
  int good = 0, all = 0;
};

Ends reliable_ends(const Eigen::VectorXd& x, Eigen::Index length, int sifts, double share) {
  const Emd whole = emd(x, {.imfs = 7, .sifts = sifts});
  Ends ends;
  for (Eigen::Index from = length; from + 2 * length <= x.size(); from += length) {
    const Emd window = emd(x.segment(from, length), {.imfs = 7, .sifts = sifts});
    REQUIRE(window.imfs.cols() == 7);
    for (Eigen::Index k = 0; k < 7; ++k) {
      const Eigen::Index half = length / 2;
      const Eigen::Index reach = std::min(window.unreliable_ends[std::size_t(k)], half);
      const Eigen::VectorXd truth = whole.imfs.col(k).segment(from, length);
      const Eigen::VectorXd error = (window.imfs.col(k) - truth).cwiseAbs();
      const double most = share * test::rms(truth);
      for (const double worst : {error.segment(reach, half - reach).maxCoeff(),
                                 error.segment(half, half - reach).maxCoeff()}) {
        ends.good += worst <= most ? 1 : 0;
        ++ends.all;
      }
    }
  }
  return ends;
}

}  // namespace

TEST_CASE("away from the ends, the IMFs are those of an independent program",
          "[analysis][emd][literature][data]") {
  // libeemd 1.4.1: not-a-knot splines, extrema extrapolated linearly. What differs at the ends dies
  // out with 2 - √3 a knot, so that slow IMFs keep some of it: 5e-6 in the slowest.
  const auto x = test::reference_data("rv_10s.f64");
  const auto reference = test::reference_data("ref_libeemd_rv10s_9imf_10sift.f64");
  if (!x || !reference) return;
  const Eigen::Index n = x->size();
  const Eigen::Map<const Eigen::MatrixXd> expected(reference->data(), n, 10);

  const Emd modes = emd(*x);
  REQUIRE(modes.imfs.cols() == 9);
  const double most[] = {1e-14, 1e-14, 1e-14, 1e-14, 1e-14, 1e-14, 1e-14, 1e-9, 2e-5};
  for (Eigen::Index k = 0; k < 9; ++k) {
    CAPTURE(k + 1);
    const Eigen::VectorXd difference = modes.imfs.col(k) - expected.col(k);
    CHECK(difference.segment(2 * n / 5, n / 5).cwiseAbs().maxCoeff() < most[k]);
  }
  CHECK((modes.residue - expected.col(9)).segment(2 * n / 5, n / 5).cwiseAbs().maxCoeff() < 2e-5);
}

TEST_CASE(
    "by the rules of an independent program, the IMFs are that program's up to their very ends",
    "[analysis][emd][literature][data]") {
  const auto x = test::reference_data("rv_10s.f64");
  const auto reference = test::reference_data("ref_libeemd_rv10s_9imf_10sift.f64");
  if (!x || !reference) return;
  const Eigen::Map<const Eigen::MatrixXd> expected(reference->data(), x->size(), 10);
  EmdOptions options;
  options.rule = {.ends = &analysis::linear_ends(), .spline = analysis::SplineEnds::not_a_knot};
  const Emd modes = emd(*x, options);
  REQUIRE(modes.imfs.cols() == 9);
  for (Eigen::Index k = 0; k < 9; ++k) {
    CAPTURE(k + 1);
    CHECK((modes.imfs.col(k) - expected.col(k)).cwiseAbs().maxCoeff() < 1e-12);
  }
  CHECK((modes.residue - expected.col(9)).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("beyond the ends marked unreliable, an IMF is that of a longer record",
          "[analysis][emd][law]") {
  const int sifts = GENERATE(1, 4, 10, 40);
  CAPTURE(sifts);
  const Ends ends = reliable_ends(test::white_noise(160000, 10), 16000, sifts, 0.01);
  CAPTURE(ends.good, ends.all);
  CHECK(ends.good >= 0.95 * ends.all);
}

TEST_CASE("and so it is with the vibration of a gear", "[analysis][emd][law][data]") {
  const auto x = test::reference_data("rv_60s.f64");
  if (!x) return;
  const Ends ends = reliable_ends(*x, 29760, 10, 0.01);
  CAPTURE(ends.good, ends.all);
  CHECK(ends.good >= 0.95 * ends.all);
}
