#include "analysis/tpa/smoothed_frfs.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "analysis/statistics.hpp"
#include "hal/types/linear_algebra.hpp"
#include "hal/types/parallel_for.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Complex = std::complex<double>;

constexpr Index half = 12, window = 2 * half + 1;
constexpr Index numerator = 6, denominator = 4;  // coefficients; those of D beside its 1
constexpr int refinements = 3;
constexpr double most_misfit = 2;
constexpr double least_denominator = 1e-3;

using WindowMatrix = Eigen::Matrix<Complex, window, window>;

// Of an element's noise: the median of the fourth differences' absolute values, robust against the
// resonances that they also see. E|Δ⁴|² is 70 times the variance, and ln 2 of a mean square is the
// median of complex noise's.
Eigen::VectorXd deviations(const Eigen::MatrixXcd& elements) {
  Eigen::VectorXd found(elements.rows());
  const Index count = elements.cols() - 4;
  for (Index i = 0; i < elements.rows(); ++i) {
    const auto row = elements.row(i);
    const Eigen::VectorXd sizes =
        (row.segment(4, count) - 4 * row.segment(3, count) + 6 * row.segment(2, count) -
         4 * row.segment(1, count) + row.segment(0, count))
            .cwiseAbs();
    found[i] = median({sizes.begin(), sizes.end()}) / std::sqrt(70 * std::log(2.0));
  }
  return found;
}

// Σ over elements of y(line)·conj(y(line + lag)): window x lines.
Eigen::MatrixXcd lagged_products(const Eigen::MatrixXcd& elements, unsigned threads) {
  const Index lines = elements.cols();
  Eigen::MatrixXcd products = Eigen::MatrixXcd::Zero(window, lines);
  const auto one = [&](std::size_t i) {
    const Index line = Index(i);
    for (Index lag = 0; lag < std::min(window, lines - line); ++lag) {
      products(lag, line) = elements.col(line + lag).dot(elements.col(line));
    }
  };
  parallel_for(std::size_t(lines), one, threads);
  return products;
}

WindowMatrix gram_from(const Eigen::MatrixXcd& products, Index first) {
  WindowMatrix gram;
  for (Index i = 0; i < window; ++i) {
    for (Index j = i; j < window; ++j) {
      gram(i, j) = products(j - i, first + i);
      gram(j, i) = std::conj(gram(i, j));
    }
  }
  return gram;
}

Index first_of_window(Index line, Index lines) {
  return std::clamp<Index>(line - half, 0, lines - window);
}

struct LineFit {
  Eigen::Matrix<Complex, 1, window> weights;  // of the window's lines, for the line's fitted value
  double remainder = 0;                       // power left over, over that of the noise
  double gain = 0;                            // share of the noise's variance that stays
};

WindowMatrix projector(const Eigen::MatrixXcd& columns) {
  const Eigen::MatrixXcd q = algebra::orthonormal_columns(columns);
  return q * q.adjoint();
}

// 1/D at the lines of the window, from the sums over all elements that the Gram matrix holds.
Eigen::VectorXcd inverse_denominator(const WindowMatrix& gram, const Eigen::MatrixXcd& powers,
                                     double elements) {
  Eigen::VectorXcd inverse = Eigen::VectorXcd::Ones(window);
  for (int i = 0; i < refinements; ++i) {
    const Eigen::VectorXcd weights = inverse.cwiseAbs().cast<Complex>();
    const WindowMatrix outside =
        WindowMatrix::Identity() - projector(weights.asDiagonal() * powers.leftCols(numerator));
    // tr((T_q·Y)ᴴ·outside·(T_r·Y)) for the diagonals T of weights·x^q
    const WindowMatrix mixed = outside.cwiseProduct(gram.transpose());
    const Eigen::MatrixXcd terms = weights.asDiagonal() * powers.leftCols(denominator + 1);
    const Eigen::MatrixXcd normal = terms.adjoint() * mixed * terms;
    Eigen::MatrixXcd square = normal.bottomRightCorner(denominator, denominator);
    // One line's noise: a flat response has no poles, and D must not be drawn by chance.
    square.diagonal().array() += elements;
    const Eigen::VectorXcd d =
        algebra::ComplexLu(square).solve(Eigen::VectorXcd(-normal.col(0).tail(denominator)));
    const Eigen::VectorXcd values =
        Eigen::VectorXcd::Ones(window) + powers.middleCols(1, denominator) * d;
    for (Index k = 0; k < window; ++k) {
      const double size = std::abs(values[k]);
      inverse[k] = size > least_denominator ? 1.0 / values[k] : Complex(1 / least_denominator);
    }
  }
  return inverse;
}

LineFit fit(const WindowMatrix& gram, Index at, double elements) {
  Eigen::MatrixXcd powers = Eigen::MatrixXcd::Ones(window, numerator);
  for (Index k = 0; k < window; ++k) {
    for (Index p = 1; p < numerator; ++p) powers(k, p) = powers(k, p - 1) * (double(k - at) / half);
  }
  const Eigen::VectorXcd inverse = inverse_denominator(gram, powers, elements);
  const WindowMatrix inside = projector(inverse.asDiagonal() * powers);
  const double left_over =
      std::max(0.0, gram.trace().real() - inside.cwiseProduct(gram.transpose()).sum().real());
  return {inside.row(at), left_over / (double(window - numerator) * elements),
          inside(at, at).real()};
}

std::vector<LineFit> fits_of(const Eigen::MatrixXcd& elements, unsigned threads) {
  const Eigen::MatrixXcd products = lagged_products(elements, threads);
  std::vector<LineFit> fits(std::size_t(elements.cols()));
  const auto one = [&](std::size_t i) {
    const Index first = first_of_window(Index(i), elements.cols());
    fits[i] = fit(gram_from(products, first), Index(i) - first, double(elements.rows()));
  };
  parallel_for(fits.size(), one, threads);
  return fits;
}

double usual_remainder(const std::vector<LineFit>& fits) {
  std::vector<double> remainders;
  for (const LineFit& fit : fits) remainders.push_back(fit.remainder);
  return median(std::move(remainders));
}

}  // namespace

SmoothedFrfs smooth_frfs(FrfMatrix frfs, unsigned threads) {
  constexpr Require require{"smooth_frfs"};
  require(frfs.values.values.allFinite(), "a value is not finite");
  const Index lines = frfs.values.lines, count = frfs.values.rows * frfs.values.columns;
  if (lines < window || count == 0) return {std::move(frfs), {}};
  Eigen::MatrixXcd elements =
      Eigen::Map<const Eigen::MatrixXcd>(frfs.values.values.data(), count, lines);
  const Eigen::VectorXd sizes = deviations(elements);
  frfs.noise = Eigen::MatrixXd::Zero(count, lines);
  if (!(sizes.maxCoeff() > 0)) return {std::move(frfs), {}};
  const Eigen::VectorXd scales = sizes.cwiseMax(1e-12 * sizes.maxCoeff());
  elements = scales.cwiseInverse().asDiagonal() * elements;
  const std::vector<LineFit> fits = fits_of(elements, threads);
  const double usual = usual_remainder(fits);
  std::vector<LineSmoothing> smoothings(std::size_t(lines), LineSmoothing{});
  for (Index line = 0; line < lines; ++line) {
    const LineFit& fit = fits[std::size_t(line)];
    LineSmoothing& smoothing = smoothings[std::size_t(line)];
    smoothing.first = first_of_window(line, lines);
    if (fit.remainder <= most_misfit * usual) smoothing.of_window = fit.weights;
    const bool is_kept = smoothing.of_window.size() == 0;
    const double gain = is_kept ? 1 : std::min(fit.gain, 1.0);
    const Eigen::VectorXd all = (is_kept ? usual : fit.remainder) * scales.cwiseAbs2();
    frfs.noise.col(line) = gain * all;
    if (frfs.variances.size() > 0) {
      frfs.variances.col(line) = (frfs.variances.col(line) - all).cwiseMax(0) + gain * all;
    }
    if (is_kept) continue;
    const Eigen::VectorXcd smooth =
        elements.middleCols(smoothing.first, window) * smoothing.of_window.transpose();
    frfs.values[line] =
        (scales.asDiagonal() * smooth).reshaped(frfs.values.rows, frfs.values.columns);
  }
  return {std::move(frfs), std::move(smoothings)};
}

Eigen::MatrixXcf smoothed_alike(const Eigen::MatrixXcf& elements,
                                const std::vector<LineSmoothing>& lines) {
  constexpr Require require{"smoothed_alike"};
  if (lines.empty()) return elements;
  require(elements.cols() == Index(lines.size()), "other lines than were smoothed");
  Eigen::MatrixXcf smooth = elements;
  for (Index line = 0; line < elements.cols(); ++line) {
    const auto& [first, of_window] = lines[std::size_t(line)];
    if (of_window.size() == 0) continue;
    smooth.col(line).noalias() = elements.middleCols(first, of_window.size()) *
                                 of_window.transpose().cast<std::complex<float>>();
  }
  return smooth;
}

}  // namespace rvbench::analysis
