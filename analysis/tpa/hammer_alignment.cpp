#include "analysis/tpa/hammer_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
using Complex = std::complex<double>;

constexpr double most_mixing = 0.2;
constexpr double small_share = 1e-3;  // of the driving points' product: near antiresonances
constexpr double unmodelled = 1e-4;   // of a pair's power: levers, which no mixing holds
constexpr int rounds = 2;
constexpr Index stretch = 32;  // of lines; more than smoothing takes together
constexpr double least_fall = 0.1;

// Which lines have their say.
enum class Lines { all, even_stretches, odd_stretches };

bool has_say(Lines lines, std::size_t line) {
  const bool is_even = Index(line) / stretch % 2 == 0;
  return lines == Lines::all || is_even == (lines == Lines::even_stretches);
}

// A column that has a row at its own place.
struct DrivingPoint {
  Index column = 0, row = 0;
};

std::vector<DrivingPoint> driving_points(const FrfMatrix& frfs) {
  std::vector<DrivingPoint> points;
  for (std::size_t column = 0; column < frfs.excitations.size(); ++column) {
    const auto row =
        std::find(frfs.responses.begin(), frfs.responses.end(), frfs.excitations[column]);
    if (row != frfs.responses.end()) {
      points.push_back({Index(column), row - frfs.responses.begin()});
    }
  }
  return points;
}

// What blows at driving point `of` may have had of another direction there.
struct Unknown {
  Index part = 0, of = 0;
};

// An answer of the equations below.
struct Told {
  Eigen::MatrixXd mixing;  // among the driving points
  double asymmetry = 0;    // of what it starts from
};

// Of all pairs, weighted as the equations are.
struct Powers {
  double apart = 0, all = 0;
};

class Reciprocity {
 public:
  Reciprocity(const FrfMatrix& frfs, const std::vector<DrivingPoint>& points)
      : count_(Index(points.size())), of_column_(points.size()) {
    const auto point_at = [&](std::size_t i) {
      return frfs.excitations[std::size_t(points[i].column)].point;
    };
    for (std::size_t of = 0; of < points.size(); ++of) {
      for (std::size_t part = 0; part < points.size(); ++part) {
        if (point_at(part) != point_at(of)) continue;
        of_column_[of].push_back(Index(unknowns_.size()));
        unknowns_.push_back({Index(part), Index(of)});
      }
    }
    for (Index line = 0; line < frfs.values.lines; ++line) add_block(frfs, points, line);
  }

  // Of what is left when this mixing has been taken out.
  Told ask(const Eigen::MatrixXd& known, Lines lines) const {
    const Eigen::MatrixXcd inverse =
        algebra::inverse(Eigen::MatrixXd::Identity(count_, count_) + known).cast<Complex>();
    const Index unknowns = Index(unknowns_.size());
    Eigen::MatrixXd square = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    Powers sums;
    for (std::size_t line = 0; line < blocks_.size(); ++line) {
      if (!has_say(lines, line)) continue;
      add_line(algebra::product(blocks_[line], inverse), noises_[line], square, right, sums);
    }
    return {solved(std::move(square), right), sums.all > 0 ? std::sqrt(sums.apart / sums.all) : 0};
  }

  // In two rounds.
  Eigen::MatrixXd mixing(Lines lines) const {
    const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(count_, count_);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count_, count_);
    for (int round = 0; round < rounds && is_small(all); ++round) {
      all = algebra::product(one + ask(all, lines).mixing, one + all) - one;
    }
    return all;
  }

  // Whether stretches of lines foresee the others: by how much less asymmetric these are.
  bool is_foreseen() const {
    if (Index(blocks_.size()) < 2 * stretch) return false;
    const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(count_, count_);
    const Eigen::MatrixXd learnt = mixing(Lines::even_stretches);
    if (!is_small(learnt)) return false;
    const double before = ask(none, Lines::odd_stretches).asymmetry;
    return ask(learnt, Lines::odd_stretches).asymmetry < (1 - least_fall) * before;
  }

  static bool is_small(const Eigen::MatrixXd& mixing) {
    return mixing.allFinite() && mixing.cwiseAbs().maxCoeff() < most_mixing;
  }

 private:
  void add_block(const FrfMatrix& frfs, const std::vector<DrivingPoint>& points, Index line) {
    Eigen::MatrixXcd& block = blocks_.emplace_back(count_, count_);
    Eigen::MatrixXd& noise = noises_.emplace_back(Eigen::MatrixXd::Zero(count_, count_));
    for (Index i = 0; i < count_; ++i) {
      for (Index j = 0; j < count_; ++j) {
        const Index row = points[std::size_t(i)].row, column = points[std::size_t(j)].column;
        block(i, j) = frfs.values[line](row, column);
        if (frfs.noise.size() > 0) noise(i, j) = frfs.noise(column * frfs.values.rows + row, line);
      }
    }
  }

  Eigen::MatrixXd solved(Eigen::MatrixXd square, const Eigen::VectorXd& right) const {
    // The mean strength, which reciprocity leaves open, stays as it is.
    const Eigen::VectorXd strength = of_strength();
    const double largest = square.diagonal().maxCoeff();
    square += largest * strength * strength.transpose();
    square.diagonal().array() += 1e-9 * largest;
    const Eigen::VectorXd found = algebra::SymmetricFactors(square).solve(right);
    Eigen::MatrixXd mixing = Eigen::MatrixXd::Zero(count_, count_);
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      mixing(unknowns_[i].part, unknowns_[i].of) = found[Index(i)];
    }
    return mixing;
  }

  // Adds the equations of a line, each pair by what is left of it if the mixing is right.
  void add_line(const Eigen::MatrixXcd& r, const Eigen::MatrixXd& noise, Eigen::MatrixXd& square,
                Eigen::VectorXd& right, Powers& sums) const {
    std::vector<std::pair<Index, Complex>> terms;
    for (Index i = 0; i < count_; ++i) {
      for (Index j = i + 1; j < count_; ++j) {
        const double size = std::norm(r(i, j)) + small_share * std::abs(r(i, i) * r(j, j));
        if (!(size > 0)) continue;
        const double weight = 1 / (unmodelled * size + noise(i, j) + noise(j, i));
        terms.clear();
        add_terms(r, i, j, 1, terms);
        add_terms(r, j, i, -1, terms);
        const Complex apart = r(i, j) - r(j, i);
        for (const auto& [a, of_a] : terms) {
          right[a] += weight * std::real(std::conj(of_a) * apart);
          for (const auto& [b, of_b] : terms) {
            square(a, b) += weight * std::real(std::conj(of_a) * of_b);
          }
        }
        sums.apart += weight * std::norm(apart);
        sums.all += weight * size;
      }
    }
  }

  // ±(R·E)_ij
  void add_terms(const Eigen::MatrixXcd& r, Index i, Index j, double sign,
                 std::vector<std::pair<Index, Complex>>& terms) const {
    for (const Index unknown : of_column_[std::size_t(j)]) {
      terms.emplace_back(unknown, sign * r(i, unknowns_[std::size_t(unknown)].part));
    }
  }

  Eigen::VectorXd of_strength() const {
    Eigen::VectorXd strength = Eigen::VectorXd::Zero(Index(unknowns_.size()));
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      if (unknowns_[i].part == unknowns_[i].of) strength[Index(i)] = 1;
    }
    return strength;
  }

  Index count_;
  std::vector<Unknown> unknowns_;
  std::vector<std::vector<Index>> of_column_;  // unknowns of each driving point's column
  std::vector<Eigen::MatrixXcd> blocks_;       // a line each: driving points x driving points
  std::vector<Eigen::MatrixXd> noises_;        // as blocks_; 0 where it is not known
};

// Errors of columns that are mixed add by power.
void mix_errors(const Eigen::MatrixXd& squares, Index rows, Eigen::MatrixXd& errors) {
  for (Index line = 0; line < errors.cols(); ++line) {
    const Eigen::MatrixXd mixed = errors.col(line).reshaped(rows, squares.rows()) * squares;
    errors.col(line) = mixed.reshaped();
  }
}

FrfMatrix without(FrfMatrix frfs, const Eigen::MatrixXd& mixing) {
  const Index n = mixing.rows();
  const Eigen::MatrixXd inverse = algebra::inverse(Eigen::MatrixXd::Identity(n, n) + mixing);
  for (Index line = 0; line < frfs.values.lines; ++line) {
    frfs.values[line] = algebra::product(frfs.values[line], inverse.cast<Complex>());
  }
  if (frfs.variances.size() > 0) mix_errors(inverse.cwiseAbs2(), frfs.values.rows, frfs.variances);
  if (frfs.noise.size() > 0) mix_errors(inverse.cwiseAbs2(), frfs.values.rows, frfs.noise);
  return frfs;
}

Eigen::MatrixXd of_all_columns(const Eigen::MatrixXd& mixing,
                               const std::vector<DrivingPoint>& points, Index columns) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(columns, columns);
  for (Index i = 0; i < mixing.rows(); ++i) {
    for (Index j = 0; j < mixing.cols(); ++j) {
      all(points[std::size_t(i)].column, points[std::size_t(j)].column) = mixing(i, j);
    }
  }
  return all;
}

}  // namespace

double HammerAlignment::largest_turn_rad() const {
  Eigen::MatrixXd turns = mixing.cwiseAbs();
  turns.diagonal().setZero();
  return turns.size() > 0 ? turns.maxCoeff() : 0;
}

HammerAlignment hammer_alignment(const FrfMatrix& frfs) {
  const Index columns = frfs.values.columns;
  HammerAlignment alignment;
  alignment.mixing = Eigen::MatrixXd::Zero(columns, columns);
  const std::vector<DrivingPoint> points = driving_points(frfs);
  if (points.size() < 2 || frfs.values.lines == 0) return alignment;
  const Reciprocity reciprocity(frfs, points);
  const Index count = Index(points.size());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(count, count);
  alignment.asymmetry_before = reciprocity.ask(none, Lines::all).asymmetry;
  const Eigen::MatrixXd mixing = reciprocity.mixing(Lines::all);
  if (!Reciprocity::is_small(mixing)) return alignment;
  alignment.asymmetry_after = reciprocity.ask(mixing, Lines::all).asymmetry;
  alignment.mixing = of_all_columns(mixing, points, columns);
  alignment.is_used = reciprocity.is_foreseen();
  return alignment;
}

FrfMatrix aligned_frfs(FrfMatrix frfs, const HammerAlignment& alignment) {
  if (!alignment.is_used) return frfs;
  return without(std::move(frfs), alignment.mixing);
}

FrfDraw aligned_draws(FrfDraw draw) {
  return [draw = std::move(draw)](std::mt19937_64& engine) {
    FrfMatrix frfs = draw(engine);
    const std::vector<DrivingPoint> points = driving_points(frfs);
    const Eigen::MatrixXd mixing = Reciprocity(frfs, points).mixing(Lines::all);
    return without(std::move(frfs), of_all_columns(mixing, points, frfs.values.columns));
  };
}

}  // namespace rvbench::analysis
