#include "analysis/frf/pole_fit.hpp"

#include <cmath>
#include <complex>
#include <vector>

#include "hal/types/linear_algebra.hpp"
#include "hal/types/require.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {

namespace {

using Complex = std::complex<double>;

constexpr int most_steps = 50;
constexpr int full_steps = 10;    // then half ones, in case they swing to and fro
constexpr double settled = 1e-9;  // of half the band

// Roots of xᵐ + Σ aⱼxʲ.
Eigen::VectorXcd roots(const Eigen::VectorXcd& a) {
  const Eigen::Index m = a.size();
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(m, m);
  if (m > 1) companion.diagonal(-1).setOnes();
  companion.col(m - 1) = -a;
  return algebra::eigenvalues(companion);
}

// The band over x in [-1, 1]; the denominator is Π (x - root).
class BandFit {
 public:
  BandFit(const Eigen::MatrixXcd& values, int poles)
      : values_(values), model_(values), poles_(poles) {
    const Eigen::Index lines = values.rows();
    x_ = Eigen::VectorXd::LinSpaced(lines, -1, 1);
    powers_.resize(lines, poles + 2);
    powers_.col(0).setOnes();
    for (Eigen::Index j = 1; j < powers_.cols(); ++j) {
      powers_.col(j) = powers_.col(j - 1).cwiseProduct(x_.cast<Complex>());
    }
    weight_ = Eigen::VectorXd::Ones(lines);
    denominator_ = Eigen::VectorXcd::Ones(lines);
    fit_numerators();
  }

  bool settle() {
    if (poles_ == 0) return true;
    model_ = values_;  // its own instrument at first
    for (int step = 0; step < most_steps; ++step) {
      const Eigen::VectorXcd before = coefficients_;
      step_poles(step >= full_steps);
      if (!roots_.allFinite()) return false;
      fit_numerators();
      if (step > 0 && (coefficients_ - before).cwiseAbs().maxCoeff() < settled) return true;
    }
    return false;
  }

  const Eigen::VectorXcd& poles() const { return roots_; }
  double left_over() const { return (values_ - model_).squaredNorm(); }
  double freedom() const { return double(values_.size() - numerators_.size() - poles_); }

  // Of a root's real and imaginary part.
  double error(Eigen::Index i, double noise) const {
    Eigen::VectorXcd slope(poles_);
    for (Eigen::Index j = 0; j < poles_; ++j) slope[j] = std::pow(roots_[i], int(j));
    const Complex variance =
        (slope.transpose() * algebra::inverse_by_full_pivots(normal_) * slope.conjugate())(0);
    return std::sqrt(0.5 * noise * std::abs(variance)) / std::abs(apart(i));
  }

  Eigen::RowVectorXcd residues(Eigen::Index i) const { return numerators_at(roots_[i]) / apart(i); }

  Eigen::RowVectorXcd model_at(double x) const {
    Complex denominator = 1;
    for (const Complex root : roots_) denominator *= x - root;
    return numerators_at(x) / denominator;
  }

 private:
  // One step of the denominator's coefficients, with the numerators' span taken out.
  void step_poles(bool halved) {
    const Eigen::MatrixXcd q = algebra::orthonormal_columns(weight_.asDiagonal() * powers_);
    const auto columns = [&](const Eigen::MatrixXcd& of, Eigen::Index power) {
      Eigen::MatrixXcd c = (weight_.cwiseProduct(powers_.col(power).real())).asDiagonal() * of;
      c -= q * (q.adjoint() * c).eval();
      return c;
    };
    std::vector<Eigen::MatrixXcd> data, instruments;
    for (Eigen::Index j = 0; j <= poles_; ++j) data.push_back(columns(values_, j));
    for (Eigen::Index j = 0; j < poles_; ++j) instruments.push_back(columns(model_, j));
    Eigen::MatrixXcd cross(poles_, poles_ + 1);
    normal_.resize(poles_, poles_);
    for (Eigen::Index i = 0; i < poles_; ++i) {
      const Eigen::MatrixXcd& z = instruments[std::size_t(i)];
      for (Eigen::Index j = 0; j <= poles_; ++j) {
        cross(i, j) = z.conjugate().cwiseProduct(data[std::size_t(j)]).sum();
        if (j < poles_)
          normal_(i, j) = z.conjugate().cwiseProduct(instruments[std::size_t(j)]).sum();
      }
    }
    const Eigen::VectorXcd next =
        algebra::solve_by_full_pivots(cross.leftCols(poles_), -cross.col(poles_));
    coefficients_ = halved ? Eigen::VectorXcd(0.5 * (coefficients_ + next)) : next;
    if (coefficients_.allFinite()) {
      roots_ = roots(coefficients_);
    } else {
      roots_ = Eigen::VectorXcd::Constant(poles_, std::nan(""));
    }
    denominator_.setOnes();
    for (const Complex root : roots_) {
      denominator_.array() *= x_.cast<Complex>().array() - root;
    }
    weight_ = denominator_.cwiseAbs().cwiseInverse();
  }

  void fit_numerators() {
    const Eigen::MatrixXcd basis = denominator_.cwiseInverse().asDiagonal() * powers_;
    numerators_ = algebra::least_squares(basis, values_);
    model_ = algebra::product(basis, numerators_);
  }

  Eigen::RowVectorXcd numerators_at(Complex x) const {
    Eigen::RowVectorXcd sum = numerators_.row(numerators_.rows() - 1);
    for (Eigen::Index j = numerators_.rows() - 2; j >= 0; --j) sum = sum * x + numerators_.row(j);
    return sum;
  }

  Complex apart(Eigen::Index i) const {
    Complex product = 1;
    for (Eigen::Index j = 0; j < poles_; ++j) {
      if (j != i) product *= roots_[i] - roots_[j];
    }
    return product;
  }

  const Eigen::MatrixXcd& values_;
  Eigen::MatrixXcd model_, powers_, numerators_, normal_;
  Eigen::Index poles_;
  Eigen::VectorXd x_, weight_;
  Eigen::VectorXcd denominator_, coefficients_, roots_;
};

}  // namespace

std::optional<PoleFit> fit_poles(const FitBand& band, int poles) {
  constexpr Require require{"fit_poles"};
  require(band.step_Hz > 0 && poles >= 0, "step_Hz must be above 0, poles not below");
  require(band.values.cols() > 0 && band.values.rows() >= poles + 4, "too few lines");
  require(band.values.allFinite(), "values must be finite");
  BandFit fit(band.values, poles);
  if (!fit.settle()) return std::nullopt;

  const double half_rad_s = units::two_pi * band.step_Hz * double(band.values.rows() - 1) / 2;
  const double centre_rad_s = units::two_pi * band.first_Hz + half_rad_s;
  const Complex j(0, 1);
  PoleFit result;
  result.left_over = fit.left_over();
  result.freedom = fit.freedom();
  result.poles_rad_s.resize(poles);
  result.errors_rad_s.resize(poles);
  result.heights.resize(poles);
  result.backgrounds.resize(poles);
  result.residues.resize(poles, band.values.cols());
  for (Eigen::Index i = 0; i < poles; ++i) {
    const Complex root = fit.poles()[i];
    result.poles_rad_s[i] = j * (centre_rad_s + half_rad_s * root);
    result.errors_rad_s[i] = half_rad_s * fit.error(i, result.left_over / result.freedom);
    const Eigen::RowVectorXcd residues = fit.residues(i);
    const Eigen::RowVectorXcd peak = residues / Complex(0, -root.imag());
    result.residues.row(i) = j * half_rad_s * residues;
    result.heights[i] = peak.norm();
    result.backgrounds[i] = (fit.model_at(root.real()) - peak).norm();
  }
  return result;
}

}  // namespace rvbench::analysis
