#include "analysis/frf/frf_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

namespace {

constexpr double least_independence = 1e-10;  // below, rounding decides

// One line of all pairs.
struct LineEstimate {
  Eigen::MatrixXcd h;           // R x E
  Eigen::VectorXd coherence;    // R
  Eigen::MatrixXd error_power;  // R x E, of either part
  double independence = 0;
};

double smallest_eigenvalue(const Eigen::MatrixXcd& gxx) {
  const Eigen::VectorXd scale = gxx.diagonal().real().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return 0;
  const Eigen::MatrixXcd scaled = scale.asDiagonal() * gxx * scale.asDiagonal();
  return algebra::hermitian_eigenvalues(scaled)[0];
}

Eigen::RowVectorXcd total_least_squares(const Eigen::MatrixXcd& gxx, const Eigen::RowVectorXcd& gyx,
                                        double gyy) {
  const Eigen::Index e = gxx.rows();
  Eigen::MatrixXcd all(e + 1, e + 1);
  all << gxx, gyx.adjoint(), gyx, gyy;
  const Eigen::VectorXd scale = all.diagonal().real().cwiseSqrt();
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  all = inverse.asDiagonal() * all * inverse.asDiagonal();
  const Eigen::VectorXcd null = algebra::hermitian_eigenvectors(all).col(0);
  return (-null.head(e).conjugate() / std::conj(null[e]) * scale[e])
      .cwiseProduct(inverse.head(e))
      .transpose();
}

LineEstimate estimate_line(const Eigen::MatrixXcd& gxx, const Eigen::MatrixXcd& gyx,
                           const Eigen::RowVectorXd& gyy, double freedom, FrfEstimator estimator) {
  const Eigen::Index r = gyx.rows(), e = gyx.cols();
  LineEstimate line{Eigen::MatrixXcd::Constant(r, e, not_known),
                    Eigen::VectorXd::Constant(r, not_known),
                    Eigen::MatrixXd::Constant(r, e, not_known), smallest_eigenvalue(gxx)};
  if (!(line.independence > least_independence)) return line;
  const Eigen::MatrixXcd inverse = algebra::inverse_of_positive(gxx);
  const Eigen::MatrixXcd h1 = algebra::product(gyx, inverse);
  for (Eigen::Index i = 0; i < r; ++i) {
    const double explained = (h1.row(i) * gyx.row(i).adjoint())(0).real();
    if (!(gyy[i] > 0)) {  // a silent response answers nothing, and that is certain
      line.h.row(i).setZero();
      continue;
    }
    line.coherence[i] = std::clamp(explained / gyy[i], 0.0, 1.0);
    const double unexplained = (1 - line.coherence[i]) * gyy[i];
    line.error_power.row(i) = unexplained / (2 * freedom) * inverse.diagonal().real().transpose();
    if (estimator == FrfEstimator::h1) line.h.row(i) = h1.row(i);
    if (estimator == FrfEstimator::h2) line.h(i, 0) = gyy[i] / std::conj(gyx(i, 0));
    if (estimator == FrfEstimator::hv) {
      line.h.row(i) = total_least_squares(gxx, gyx.row(i), gyy[i]);
    }
    if (estimator == FrfEstimator::h1) continue;
    for (Eigen::Index j = 0; j < e; ++j) {
      line.error_power(i, j) *= std::norm(line.h(i, j) / h1(i, j));
    }
  }
  return line;
}

EstimatedResponse pair_of(const std::vector<LineEstimate>& lines, const CrossSpectra& spectra,
                          double freedom, Eigen::Index i, Eigen::Index j) {
  const auto n = Eigen::Index(lines.size());
  EstimatedResponse pair;
  pair.freedom = freedom;
  FrequencyResponse& frf = pair.response;
  frf.step_Hz = spectra.step_Hz;
  frf.averages = spectra.records;
  frf.values.resize(n);
  frf.coherence.resize(n);
  pair.standard_error.resize(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const LineEstimate& line = lines[std::size_t(k)];
    frf.values[k] = line.h(i, j);
    frf.coherence[k] = line.coherence[i];
    pair.standard_error[k] = pair.freedom > 0 ? std::sqrt(line.error_power(i, j)) : not_known;
  }
  if (!(pair.freedom > 0)) frf.coherence.resize(0);  // 1 by construction
  const Eigen::Index lost = n - frf.values.real().array().isFinite().count();
  if (lost > 0) {
    frf.notes.push_back(
        fmt::format("{} of {} lines are not known: excitations silent or dependent", lost, n));
  }
  return pair;
}

}  // namespace

const char* to_string(FrfEstimator estimator) noexcept {
  switch (estimator) {
    case FrfEstimator::h1: return "H1";
    case FrfEstimator::h2: return "H2";
    case FrfEstimator::hv: return "Hv";
  }
  return "unknown";
}

FrfEstimates estimate_responses(const CrossSpectra& spectra, const FrfSetup& setup,
                                FrfEstimator estimator, const std::string& source) {
  constexpr Require require{"estimate_responses"};
  const auto e = Eigen::Index(setup.excitations.size());
  const auto r = Eigen::Index(setup.responses.size());
  require(spectra.lines() > 0 && e > 0 && spectra.responses.cols() == r &&
              spectra.cross.front().cols() == e,
          "spectra are not those of the setup");
  require(estimator != FrfEstimator::h2 || e == 1, "H2 is for one excitation");
  const double freedom = std::max(spectra.averages - double(e), 0.0);
  std::vector<LineEstimate> lines(static_cast<std::size_t>(spectra.lines()));
  parallel_for(lines.size(), [&](std::size_t k) {
    lines[k] = estimate_line(spectra.excitations[k], spectra.cross[k],
                             spectra.responses.row(Eigen::Index(k)), freedom, estimator);
  });

  FrfEstimates estimates;
  for (Eigen::Index i = 0; i < r; ++i) {
    for (Eigen::Index j = 0; j < e; ++j) {
      EstimatedResponse pair = pair_of(lines, spectra, freedom, i, j);
      pair.response.source = fmt::format("{}: {}", source, to_string(estimator));
      pair.response.response = setup.responses[std::size_t(i)].place;
      pair.response.response_unit = setup.responses[std::size_t(i)].unit;
      pair.response.excitation = setup.excitations[std::size_t(j)].place;
      pair.response.excitation_unit = setup.excitations[std::size_t(j)].unit;
      estimates.responses.push_back(std::move(pair));
    }
  }
  estimates.independence = Eigen::VectorXd::NullaryExpr(
      spectra.lines(), [&](Eigen::Index k) { return lines[std::size_t(k)].independence; });
  return estimates;
}

Eigen::VectorXd confidence_radius(const EstimatedResponse& estimate, double p) {
  constexpr Require require{"confidence_radius"};
  require(p > 0 && p < 1, "p must be within 0 and 1");
  const double m = estimate.freedom;
  const double widths = m > 0 ? std::sqrt(2 * m * std::expm1(-std::log(p) / m)) : not_known;
  return widths * estimate.standard_error;
}

}  // namespace rvbench::analysis
