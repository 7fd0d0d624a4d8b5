#include <catch2/catch.hpp>

#include "analysis/emd/emd.hpp"
#include "tests/support/reference_data.hpp"
#include "tests/support/signals.hpp"
#include "tests/support/under_sanitizer.hpp"

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

EmdOptions with(const analysis::EndRule& ends) {
  EmdOptions options;
  options.rule = {.ends = &ends, .spline = analysis::SplineEnds::not_a_knot};
  return options;
}

// Over the first and last 1 % and 5 % of windows alone, against the same windows of the whole
// record: squares of the error of each IMF, and of the IMF.
struct EndErrors {
  Eigen::ArrayXd close, wide, all;

  Eigen::ArrayXXd relative() const {
    Eigen::ArrayXXd both(all.size(), 2);
    both << (close / all).sqrt(), (wide / all).sqrt();
    return both;
  }
};

EndErrors end_errors(const Eigen::VectorXd& x, const std::vector<Eigen::Index>& froms,
                     Eigen::Index length, const EmdOptions& options) {
  const Emd whole = emd(x, options);
  const Eigen::Index imfs = whole.imfs.cols();
  const Eigen::ArrayXd zero = Eigen::ArrayXd::Zero(imfs);
  EndErrors errors{zero, zero, zero};
  for (const Eigen::Index from : froms) {
    const Emd alone = emd(x.segment(from, length), options);
    REQUIRE(alone.imfs.cols() == imfs);
    const Eigen::ArrayXXd truth = whole.imfs.middleRows(from, length).array();
    const Eigen::ArrayXXd squares = (alone.imfs.array() - truth).square();
    const auto at_ends = [&](Eigen::Index reach) -> Eigen::ArrayXd {
      return (squares.topRows(reach) + squares.bottomRows(reach)).colwise().mean() / 2;
    };
    errors.close += at_ends(length / 100);
    errors.wide += at_ends(length / 20);
    errors.all += truth.square().colwise().mean().transpose();
  }
  return errors;
}

std::vector<Eigen::Index> windows_of(const Eigen::VectorXd& x, Eigen::Index length) {
  std::vector<Eigen::Index> froms;
  for (Eigen::Index from = length; from + 2 * length <= x.size(); from += length / 8) {
    froms.push_back(from);
  }
  return froms;
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
  const Emd modes = emd(*x, with(analysis::linear_ends()));
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

TEST_CASE("mirrored, the ends of a window err as those of an independent program",
          "[analysis][emd][literature][data]") {
  // PyEMD 1.10.2, which mirrors two extrema under not-a-knot splines: 25 to 35 s of the record,
  // IMF 1, 3, 5, 7 within 0.1 s and within 0.5 s of the ends.
  const auto x = test::reference_data("rv_60s.f64");
  if (!x) return;
  const auto errors =
      end_errors(*x, {25 * 4960}, 49600, with(analysis::mirrored_ends())).relative();
  const double close[] = {.09, .10, .19, .67}, wide[] = {.04, .05, .09, .36};
  for (int i = 0; i < 4; ++i) {
    CAPTURE(2 * i + 1);
    CHECK(errors(2 * i, 0) == Approx(close[i]).margin(0.005));
    CHECK(errors(2 * i, 1) == Approx(wide[i]).margin(0.005));
  }
}

// Of a single window chance tells, so over many.
TEST_CASE("on a gear's vibration the default end rule errs less than the mirror in every IMF",
          "[analysis][emd][law][data]") {
  const auto x = test::reference_data("rv_60s.f64");
  if (!x) return;
  const auto froms = windows_of(*x, 49600);
  const auto ours = end_errors(*x, froms, 49600, {}).relative();
  const auto mirrored = end_errors(*x, froms, 49600, with(analysis::mirrored_ends())).relative();
  CAPTURE(ours, mirrored);
  CHECK((ours.col(0) < mirrored.col(0)).all());
  // Of IMF 9, a window holds a few periods: as far as 0.5 s from its ends it is no end any more.
  CHECK((ours.col(1) < mirrored.col(1)).head(8).all());
}

TEST_CASE("and so it does on noise", "[analysis][emd][law]") {
  if (test::too_long_under_sanitizer()) return;
  constexpr Eigen::Index length = 4000;
  EmdOptions ours, mirrored = with(analysis::mirrored_ends());
  ours.imfs = mirrored.imfs = 6;
  Eigen::ArrayXXd log_ratios(40, 12);
  for (int record = 0; record < log_ratios.rows(); ++record) {
    const Eigen::VectorXd x = test::white_noise(6 * length, unsigned(record));
    const auto froms = windows_of(x, length);
    const Eigen::ArrayXXd ratio = end_errors(x, froms, length, ours).relative() /
                                  end_errors(x, froms, length, mirrored).relative();
    log_ratios.row(record) = ratio.log().reshaped().transpose();
  }
  for (const auto& ratio : log_ratios.colwise()) CHECK(ratio.mean() < 0);
}
