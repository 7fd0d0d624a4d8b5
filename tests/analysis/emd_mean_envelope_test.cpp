#include <catch2/catch.hpp>

#include "analysis/emd/mean_envelope.hpp"
#include "hal/types/linear_algebra.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Knots;
using analysis::MeanEnvelope;

namespace {

// The natural cubic spline as its definition has it: four unknowns a segment; values, slopes and
// curvatures meet at the knots, no curvature at either end; solved as a dense system.
Eigen::VectorXd natural_spline(const Eigen::VectorXd& at, const Eigen::VectorXd& value,
                               Eigen::Index samples) {
  const Eigen::Index segments = at.size() - 1;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(4 * segments, 4 * segments);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(4 * segments);
  Eigen::Index row = 0;
  for (Eigen::Index s = 0; s < segments; ++s) {
    const double w = at[s + 1] - at[s];
    a(row, 4 * s) = 1;
    b[row++] = value[s];
    a.row(row).segment(4 * s, 4) << 1, w, w * w, w * w * w;
    b[row++] = value[s + 1];
    if (s + 1 == segments) continue;
    a.row(row).segment(4 * s, 6) << 0, 1, 2 * w, 3 * w * w, 0, -1;
    ++row;
    a.row(row).segment(4 * s, 7) << 0, 0, 2, 6 * w, 0, 0, -2;
    ++row;
  }
  a(row++, 2) = 1;
  a.row(row).tail(2) << 1, 3 * (at[segments] - at[segments - 1]);
  const Eigen::VectorXd coefficients = algebra::MinimumNorm(a).solve(b);

  Eigen::VectorXd out(samples);
  for (Eigen::Index i = 0, s = 0; i < samples; ++i) {
    while (s + 1 < segments && at[s + 1] <= static_cast<double>(i)) ++s;
    const double u = static_cast<double>(i) - at[s];
    out[i] = coefficients.segment(4 * s, 4).dot(Eigen::Vector4d(1, u, u * u, u * u * u));
  }
  return out;
}

Eigen::VectorXd every_second(const std::vector<double>& x, std::size_t from) {
  Eigen::VectorXd out(static_cast<Eigen::Index>((x.size() - from + 1) / 2));
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = x[from + 2 * std::size_t(i)];
  return out;
}

// Of envelopes through these extrema, which span h.
void subtract_mean(Eigen::VectorXd& h, const std::vector<double>& at,
                   const std::vector<double>& value) {
  Knots knots;
  for (std::size_t j = 0; j < at.size(); ++j) knots.push_back(at[j], value[j]);
  MeanEnvelope mean;
  mean.begin(8);
  mean.subtract_rest(analysis::sift_kernels(), h.data(), h.size(), knots);
}

}  // namespace

TEST_CASE("the mean envelope is the mean of two natural cubic splines",
          "[analysis][emd][literature]") {
  // De Boor, A Practical Guide to Splines (2001), ch. IV.
  const std::vector<double> at{-7.5, -3, 0, 2.5, 4, 10, 11, 19.5, 20, 31, 33.5, 40};
  const std::vector<double> value{1, -2, 3, -1, 0.5, -4, 2, 1.5, 6, -3, 2, 0};
  const Eigen::Index samples = GENERATE(33, 34);  // up to just before and just after the last knot
  const Eigen::VectorXd upper =
      natural_spline(every_second(at, 0), every_second(value, 0), samples);
  const Eigen::VectorXd lower =
      natural_spline(every_second(at, 1), every_second(value, 1), samples);

  Eigen::VectorXd h = test::white_noise(samples, 9);
  const Eigen::VectorXd expected = h - (upper + lower) / 2;
  subtract_mean(h, at, value);
  CHECK((h - expected).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("straight envelopes have a straight mean", "[analysis][emd][law]") {
  std::vector<double> at, value;
  for (int i = -2; i < 20; ++i) {
    const double t = 3.5 * i;
    at.push_back(t);
    value.push_back(0.25 * t + (i % 2 == 0 ? 1 : -1));
  }
  Eigen::VectorXd h = Eigen::VectorXd::Zero(60);
  subtract_mean(h, at, value);
  CHECK((h + 0.25 * test::times_s(60, 1).matrix()).cwiseAbs().maxCoeff() < 1e-13);
}
