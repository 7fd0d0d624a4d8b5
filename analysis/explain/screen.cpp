#include "analysis/explain/screen.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/explain/fit_problem.hpp"
#include "analysis/statistics.hpp"
#include "hal/types/linear_algebra.hpp"
#include "hal/types/parallel_for.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t most_marked_anew = 40;
constexpr double screening_step = 1e-3;  // of a start's size: small, but not in the last digits

// Takes out of a vector what the columns of a matrix span.
class Projector {
 public:
  explicit Projector(const Eigen::MatrixXd& columns) : basis_(columns.rows(), 0) {
    if (columns.cols() == 0) return;
    // Columns of different units: scaled first, so that the rank is told from directions alone.
    Eigen::MatrixXd scaled = columns;
    for (Eigen::Index i = 0; i < scaled.cols(); ++i) {
      const double norm = scaled.col(i).norm();
      if (norm > 0) scaled.col(i) /= norm;
    }
    basis_ = algebra::basis_of_columns(scaled);
  }

  Eigen::VectorXd remainder(const Eigen::VectorXd& x) const {
    return x - basis_ * (basis_.transpose() * x);
  }

 private:
  Eigen::MatrixXd basis_;
};

Eigen::VectorXd only_trained(const ForwardModel& model, Eigen::VectorXd x,
                             const std::vector<bool>& trained) {
  for (std::size_t u = 0; u < trained.size(); ++u) {
    const ObservedUnit& unit = model.units()[u];
    if (!trained[u]) x.segment(unit.first, unit.size).setZero();
  }
  return x;
}

// What a fit leaves over, what its numbers can do to that, and what is known of these beforehand
// as rows below.
class LeftOver {
 public:
  LeftOver(const ForwardModel& model, const Fit& fit, const std::vector<bool>& trained)
      : prior_(FitProblem(model, fit.effects, trained, fit.scatter)),
        known_(slopes_of(model, fit, trained)) {
    residuals_ = with_rows(only_trained(model, fit.residuals, trained));
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      residuals_[fit.residuals.size() + Eigen::Index(p)] = prior_.residual(p, fit.values);
    }
    residuals_ = known_.remainder(residuals_);
  }

  const Eigen::VectorXd& residuals() const { return residuals_; }

  // Of a mark on the residuals: what no number of the fit can do within what is known of it.
  Eigen::VectorXd unknown_of(Eigen::VectorXd mark) const {
    return known_.remainder(with_rows(std::move(mark)));
  }

 private:
  Eigen::VectorXd with_rows(Eigen::VectorXd x) const {
    const Eigen::Index size = x.size();
    x.conservativeResize(size + Eigen::Index(prior_.of.size()));
    x.tail(x.size() - size).setZero();
    return x;
  }

  Eigen::MatrixXd slopes_of(const ForwardModel& model, const Fit& fit,
                            const std::vector<bool>& trained) const {
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(
        fit.slopes.rows() + Eigen::Index(prior_.of.size()), fit.slopes.cols());
    for (Eigen::Index i = 0; i < slopes.cols(); ++i) {
      slopes.col(i) = with_rows(only_trained(model, fit.slopes.col(i), trained));
    }
    for (std::size_t p = 0; p < prior_.of.size(); ++p) {
      slopes(fit.slopes.rows() + Eigen::Index(p), Eigen::Index(prior_.of[p])) =
          1 / prior_.spread[p];
    }
    return slopes;
  }

  Prior prior_;
  Projector known_;
  Eigen::VectorXd residuals_;
};

// The score of one direction, unit by unit.
Eigen::VectorXd scores_of(const ForwardModel& model, const Eigen::VectorXd& direction,
                          const Eigen::VectorXd& left_over, const std::vector<bool>& trained) {
  std::vector<double> scores;
  for (std::size_t u = 0; u < trained.size(); ++u) {
    if (!trained[u]) continue;
    const ObservedUnit& unit = model.units()[u];
    scores.push_back(
        direction.segment(unit.first, unit.size).dot(left_over.segment(unit.first, unit.size)));
  }
  return Eigen::Map<Eigen::VectorXd>(scores.data(), Eigen::Index(scores.size()));
}

// Of the mean of n scores being zero.
double p_value_of(const Eigen::VectorXd& scores) {
  const auto n = static_cast<double>(scores.size());
  if (n < 2) return 1;
  const double variance = (scores.array() - scores.mean()).square().sum() / (n - 1);
  return variance > 0 ? t_p_value(scores.mean() / std::sqrt(variance / n), n - 1) : 1;
}

// A small wave leaves no trace in amplitudes where it stands alone in noise.
bool is_small_when_screened(const Candidate& candidate) {
  return candidate.when_small == Candidate::WhenSmall::in_proportion && !candidate.phasor;
}

// How the residuals change with the candidate's size, from nothing, at one start's shape.
Eigen::VectorXd mark_of(const ForwardModel& model, const Fit& fit, std::size_t effect,
                        const std::vector<double>& start, const std::vector<bool>& trained) {
  std::vector<std::size_t> effects = fit.effects;
  effects.push_back(effect);
  std::vector<double> values = fit.values;
  values.insert(values.end(), start.begin(), start.end());
  const Candidate& candidate = model.library()[effect];
  const double part = is_small_when_screened(candidate) ? screening_step : 1;
  for (std::size_t i = 0; i < candidate.sizes; ++i) values[fit.values.size() + i] *= part;
  const auto moved = model.residuals(effects, values, trained);
  if (!moved || !moved->allFinite()) return {};
  return (*moved - fit.residuals) / part;
}

// Whether two starts leave the same mark but for its length: their sizes are in one proportion, and
// their shapes the same.
bool leave_one_mark(const Candidate& candidate, const std::vector<double>& a,
                    const std::vector<double>& b) {
  if (!is_small_when_screened(candidate)) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (i < candidate.sizes ? a[i] * b[0] != b[i] * a[0] : a[i] != b[i]) return false;
  }
  return true;
}

// Of several sizes one may be out of bounds, and the others still explain something.
bool may_be(const Candidate& candidate, const std::vector<double>& values) {
  if (values.empty() || candidate.sizes > 1) return true;
  const ModelParameter& size = candidate.parameters.front();
  return values.front() > size.low && values.front() < size.high;
}

// Per start of a candidate: its mark; empty where an earlier start leaves the same, or none is
// left.
std::vector<Eigen::VectorXd> marks_of(const ForwardModel& model, const Fit& fit, std::size_t effect,
                                      const std::vector<bool>& trained) {
  const Candidate& candidate = model.library()[effect];
  std::vector<Eigen::VectorXd> marks;
  for (auto start = candidate.starts.begin(); start != candidate.starts.end(); ++start) {
    const bool is_seen = std::any_of(candidate.starts.begin(), start, [&](const auto& earlier) {
      return leave_one_mark(candidate, earlier, *start);
    });
    Eigen::VectorXd mark;
    if (!is_seen) mark = mark_of(model, fit, effect, *start, trained);
    if (mark.size() > 0) mark = only_trained(model, std::move(mark), trained);
    marks.push_back(std::move(mark));
  }
  return marks;
}

Screened screened(const ForwardModel& model, std::size_t effect,
                  const std::vector<Eigen::VectorXd>& marks, const LeftOver& left_over,
                  const std::vector<bool>& trained) {
  Screened best;
  best.effect = effect;
  const Candidate& candidate = model.library()[effect];
  for (std::size_t s = 0; s < marks.size(); ++s) {
    if (marks[s].size() == 0) continue;
    Eigen::VectorXd mark = left_over.unknown_of(marks[s]);
    const double norm = mark.norm();
    if (!(norm > 1e-6 * marks[s].norm())) continue;  // what is there already could do all of it
    mark /= norm;
    const double along = mark.dot(left_over.residuals());
    const double explains = along * along / left_over.residuals().squaredNorm();
    if (explains <= best.explains) continue;
    Eigen::VectorXd scores = scores_of(model, mark, left_over.residuals(), trained);
    best = {effect, explains, p_value_of(scores), std::move(scores), std::move(mark), {}, true};
    if (!is_small_when_screened(candidate)) continue;
    best.start = candidate.resized(candidate.starts[s], -along / norm);
    best.is_admissible = may_be(candidate, best.start);
    if (best.is_admissible || !candidate.has_far_starts) continue;
    best.start.clear();  // what a small one does says nothing of a large one in another valley
    best.is_admissible = true;
  }
  return best;
}

// All of them by the marks that there are, strongest first.
std::vector<Screened> by_marks(const ForwardModel& model, const std::vector<std::size_t>& effects,
                               const Marks& marks, const LeftOver& left_over,
                               const std::vector<bool>& trained) {
  std::vector<Screened> all(effects.size());
  parallel_for(effects.size(), [&](std::size_t i) {
    all[i] = screened(model, effects[i], marks[effects[i]], left_over, trained);
  });
  std::erase_if(all, [](const Screened& s) { return s.direction.size() == 0; });
  std::ranges::sort(all, std::ranges::greater{}, &Screened::explains);
  return all;
}

}  // namespace

std::vector<Screened> screen(const ForwardModel& model, const Fit& fit,
                             const std::vector<bool>& trained, Marks& marks) {
  const LeftOver left_over(model, fit, trained);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < model.library().size(); ++i) {
    const bool held = std::ranges::find(fit.effects, i) != fit.effects.end();
    if (!held && model.library()[i].not_exercised.empty()) open.push_back(i);
  }
  if (!marks.empty()) {
    const std::vector<Screened> earlier = by_marks(model, open, marks, left_over, trained);
    open.clear();
    for (const Screened& s : earlier) open.push_back(s.effect);
    if (open.size() > most_marked_anew) open.resize(most_marked_anew);
  }
  Marks now(model.library().size());
  parallel_for(open.size(),
               [&](std::size_t i) { now[open[i]] = marks_of(model, fit, open[i], trained); });
  std::vector<Screened> all = by_marks(model, open, now, left_over, trained);
  if (marks.empty()) marks = std::move(now);
  return all;
}

std::vector<double> done_by_others(const ForwardModel& model, const Fit& fit) {
  const auto slopes_of = [&](std::size_t place) {
    const std::size_t count = model.library()[fit.effects[place]].parameters.size();
    return fit.slopes.middleCols(Eigen::Index(first_value_of(model, fit.effects, place)),
                                 Eigen::Index(count));
  };
  const std::size_t last = fit.effects.size() - 1;
  if (model.library()[fit.effects[last]].when_small != Candidate::WhenSmall::in_proportion) {
    return std::vector<double>(last, 0.0);
  }
  const auto sizes = Eigen::Index(model.library()[fit.effects[last]].sizes);
  const Eigen::Map<const Eigen::VectorXd> values(
      fit.values.data() + first_value_of(model, fit.effects, last), sizes);
  const Eigen::VectorXd does = slopes_of(last).leftCols(sizes) * values;
  const Eigen::MatrixXd base = fit.slopes.leftCols(Eigen::Index(model.base().size()));
  const double beyond_base = Projector(base).remainder(does).squaredNorm();
  std::vector<double> shares;
  for (std::size_t e = 0; e < last; ++e) {
    Eigen::MatrixXd both(base.rows(), base.cols() + slopes_of(e).cols());
    both << base, slopes_of(e);
    const double beyond_both = Projector(both).remainder(does).squaredNorm();
    shares.push_back(beyond_base > 0 ? 1 - beyond_both / beyond_base : 0);
  }
  return shares;
}

double pair_explains(const Screened& a, const Screened& b) {
  const double alike = a.direction.dot(b.direction);
  const double apart = 1 - alike * alike;
  if (apart < 1e-9) return std::max(a.explains, b.explains);
  const double first = std::copysign(std::sqrt(a.explains), a.scores.sum());
  const double second = std::copysign(std::sqrt(b.explains), b.scores.sum());
  return (a.explains + b.explains - 2 * alike * first * second) / apart;
}

bool pair_is_admissible(const ForwardModel& model, const Screened& a, const Screened& b) {
  const double alike = a.direction.dot(b.direction);
  const double apart = 1 - alike * alike;
  if (apart < 1e-9) return a.is_admissible && b.is_admissible;
  const double first = a.scores.sum(), second = b.scores.sum();
  const auto is_admissible = [&](const Screened& s, double own, double other) {
    const Candidate& candidate = model.library()[s.effect];
    const double by = (own - alike * other) / apart / own;
    return s.start.empty() || may_be(candidate, candidate.resized(s.start, by));
  };
  return is_admissible(a, first, second) && is_admissible(b, second, first);
}

double pair_p_value(const Screened& a, const Screened& b) {
  const auto n = static_cast<double>(a.scores.size());
  if (n < 4) return 1;
  Eigen::MatrixXd scores(a.scores.size(), 2);
  scores << a.scores, b.scores;
  const Eigen::VectorXd mean = scores.colwise().mean();
  const Eigen::MatrixXd away = scores.rowwise() - mean.transpose();
  const Eigen::MatrixXd covariance = algebra::gram(away) / (n - 1);
  const double t2 = n * mean.dot(algebra::MinimumNorm(covariance).solve(mean));
  // T² (n − 2) / (2 (n − 1)) is F(2, n − 2), whose tail has a closed form.
  return std::pow(1 + t2 / (n - 1), -(n - 2) / 2);
}

}  // namespace rvbench::analysis
