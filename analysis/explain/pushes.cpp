#include "analysis/explain/pushes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "analysis/statistics.hpp"
#include "hal/types/linear_algebra.hpp"

namespace rvbench::analysis {
namespace {

using Complex = std::complex<double>;
using Group = std::vector<const PushedLine*>;  // of one number

constexpr double alike = 0.95;            // |cos| of responses
constexpr double load_must_change = 0.5;  // of the largest: less may be drag that grows with speed
constexpr int phases_tried = 8;
constexpr int most_rounds = 300;
constexpr double settled = 1e-7;
constexpr double most_of_it = 0.5;
constexpr double chance = 0.01;
constexpr double told_apart = 4;  // times the squares that the best site, or noise, leaves over

bool is_in(const PushedLine& line, const ResidualCluster& c) {
  return line.channel == c.channel && line.locked_to == c.locked_to && line.place >= c.first &&
         line.place <= c.last;
}

std::vector<Group> groups_of(const std::vector<PushedLine>& lines,
                             const std::vector<ResidualCluster>& found) {
  std::map<std::pair<LockedTo, int>, Group> by_number;
  for (const PushedLine& line : lines) by_number[{line.locked_to, line.number}].push_back(&line);
  std::vector<Group> groups;
  for (auto& [number, group] : by_number) {
    const bool is_found = std::ranges::any_of(group, [&](const PushedLine* line) {
      return std::ranges::any_of(found, [&](const auto& c) { return is_in(*line, c); });
    });
    if (is_found) groups.push_back(std::move(group));
  }
  return groups;
}

// 1, and the load as a share of the largest if it changes.
Eigen::MatrixXd laws_of(const Group& group) {
  Eigen::MatrixXd laws = Eigen::MatrixXd::Ones(Eigen::Index(group.size()), 2);
  for (std::size_t i = 0; i < group.size(); ++i) laws(Eigen::Index(i), 1) = group[i]->load;
  const double largest = laws.col(1).cwiseAbs().maxCoeff();
  const bool changes = laws.col(1).maxCoeff() - laws.col(1).minCoeff() > load_must_change * largest;
  if (!changes) return laws.leftCols(1);
  laws.col(1) /= largest;
  return laws;
}

double off(const PushedLine& line, Complex added) {
  return (line.measured - std::hypot(std::abs(line.predicted + added), line.floor)) /
         line.standard_error;
}

using Squares = Eigen::VectorXd;  // of standard errors, one for each line of a group

Squares squares_of(const Group& group, const Eigen::VectorXcd& added) {
  Squares squares(added.size());
  for (Eigen::Index i = 0; i < added.size(); ++i) {
    squares[i] = std::pow(off(*group[std::size_t(i)], added[i]), 2);
  }
  return squares;
}

Squares squares_before(const Group& group) {
  return squares_of(group, Eigen::VectorXcd::Zero(Eigen::Index(group.size())));
}

// What forces at one site have to bring.
struct Wanted {
  Eigen::MatrixXcd adds;  // lines x numbers of the force's law
  Eigen::VectorXcd predicted;
  Eigen::VectorXd amplitude, weight;
};

Wanted wanted_of(const Group& group, std::size_t site, const Eigen::MatrixXd& laws) {
  const auto n = static_cast<Eigen::Index>(group.size());
  Wanted wanted{laws.cast<Complex>(), Eigen::VectorXcd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const PushedLine& line = *group[std::size_t(i)];
    wanted.adds.row(i) *= line.response[Eigen::Index(site)];
    wanted.predicted[i] = line.predicted;
    wanted.amplitude[i] =
        std::sqrt(std::max(line.measured * line.measured - line.floor * line.floor, 0.0));
    wanted.weight[i] = 1 / line.standard_error;
  }
  return wanted;
}

// Goes back and forth: phases of the force found so far to the measured amplitudes, the force that
// comes nearest to these. No step makes the misfit larger, so only where it begins counts.
Eigen::VectorXcd settled_from(Eigen::VectorXcd force, const Wanted& wanted,
                              const algebra::ComplexLeastSquares& nearest) {
  for (int round = 0; round < most_rounds; ++round) {
    const Eigen::VectorXcd line = wanted.predicted + wanted.adds * force;
    const Eigen::VectorXcd way =
        line.unaryExpr([](const Complex& z) { return z == 0.0 ? Complex(1) : z / std::abs(z); });
    const Eigen::VectorXcd next = nearest.solve(wanted.weight.cwiseProduct(
        wanted.amplitude.cast<Complex>().cwiseProduct(way) - wanted.predicted));
    const double moved = (next - force).norm();
    force = next;
    if (moved <= settled * force.norm()) break;
  }
  return force;
}

// The best force at one site: what it leaves, and its size.
struct LineFit {
  Squares left;
  double size = 0;
};

LineFit fit(const Group& group, std::size_t site) {
  const Eigen::MatrixXd laws = laws_of(group);
  const Wanted wanted = wanted_of(group, site, laws);
  const algebra::ComplexLeastSquares nearest(wanted.weight.asDiagonal() * wanted.adds);
  const double answer = wanted.weight.cwiseProduct(wanted.adds.col(0)).norm();
  LineFit best{squares_before(group), 0};
  if (answer == 0) return best;
  const double usual = std::sqrt(best.left.sum()) / answer;
  for (int phase = 0; phase < phases_tried; ++phase) {
    Eigen::VectorXcd force = Eigen::VectorXcd::Zero(laws.cols());
    force[0] = std::polar(usual, 2 * std::numbers::pi * phase / phases_tried);
    force = settled_from(std::move(force), wanted, nearest);
    const Squares left = squares_of(group, wanted.adds * force);
    if (left.sum() >= best.left.sum()) continue;
    best = {left, std::sqrt((laws * force).squaredNorm() / double(group.size()))};
  }
  return best;
}

// Of a ratio of sums, by the scatter of its parts about it.
double error_of_ratio(const Squares& over, const Squares& under) {
  const double ratio = over.sum() / under.sum();
  const auto n = static_cast<double>(over.size());
  return std::sqrt(n / (n - 1)) * (over - ratio * under).norm() / under.sum();
}

double likeness(const Group& group, std::size_t a, std::size_t b) {
  Complex ab = 0;
  double aa = 0, bb = 0;
  for (const PushedLine* line : group) {
    const Complex of_a = line->response[Eigen::Index(a)] / line->standard_error;
    const Complex of_b = line->response[Eigen::Index(b)] / line->standard_error;
    ab += std::conj(of_a) * of_b;
    aa += std::norm(of_a);
    bb += std::norm(of_b);
  }
  return aa > 0 && bb > 0 ? std::abs(ab) / std::sqrt(aa * bb) : 0;
}

void mark_as_good(const Group& group, const std::vector<double>& left, double freedom,
                  std::vector<SitePush>& sites) {
  const double most = told_apart * std::max(std::ranges::min(left), freedom);
  for (SitePush& push : sites) {
    push.is_as_good = std::ranges::any_of(sites, [&](const SitePush& other) {
      return left[other.site] <= most &&
             (other.site == push.site || likeness(group, other.site, push.site) > alike);
    });
  }
}

// With all its sites, as good or not.
LinePushes explained(const Group& group) {
  LinePushes line{group.front()->locked_to, group.front()->place, {}};
  const auto n = static_cast<double>(group.size());
  const double unknowns = 2 * static_cast<double>(laws_of(group).cols());
  const double freedom = n - unknowns;
  const Squares before = squares_before(group);
  std::vector<double> left;
  for (std::size_t site = 0; site < std::size_t(group.front()->response.size()); ++site) {
    const LineFit fitted = fit(group, site);
    left.push_back(fitted.left.sum());
    const double gain = (before.sum() - left.back()) / left.back();
    line.sites.push_back({site, 1 - n / freedom * left.back() / before.sum(),
                          n / freedom * error_of_ratio(fitted.left, before),
                          line_p_value(gain * freedom / 2, unknowns / 2, freedom / 2),
                          fitted.size});
  }
  mark_as_good(group, left, freedom, line.sites);
  std::ranges::stable_sort(line.sites, std::ranges::greater{}, &SitePush::share);
  return line;
}

std::vector<std::size_t> as_good_sites(const LinePushes& line) {
  std::vector<std::size_t> sites;
  for (const SitePush& push : line.sites) {
    if (push.is_as_good) sites.push_back(push.site);
  }
  return sites;
}

// The site that the most of these lines may come from; of several, the first that is met.
std::size_t commonest_site(const std::vector<LinePushes>& lines,
                           const std::vector<std::size_t>& open) {
  std::vector<std::size_t> met;
  for (const std::size_t line : open) {
    const std::vector<std::size_t> sites = as_good_sites(lines[line]);
    met.insert(met.end(), sites.begin(), sites.end());
  }
  return *std::ranges::max_element(met, {},
                                   [&](std::size_t site) { return std::ranges::count(met, site); });
}

// Each time the site that the most of the lines left may come from, and with it the sites that each
// of these lines may come from as well.
std::vector<PushSource> sources_of(const std::vector<LinePushes>& lines) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const bool may_be_anywhere = as_good_sites(lines[i]).size() == lines[i].sites.size();
    if (lines[i].are_explained() && !may_be_anywhere) open.push_back(i);
  }
  std::vector<PushSource> sources;
  while (!open.empty()) {
    const std::size_t site = commonest_site(lines, open);
    PushSource source;
    std::vector<std::size_t> others;
    for (const std::size_t line : open) {
      const std::vector<std::size_t> sites = as_good_sites(lines[line]);
      if (std::ranges::find(sites, site) == sites.end()) {
        others.push_back(line);
        continue;
      }
      if (source.lines.empty()) source.sites = sites;
      source.lines.push_back(line);
      std::erase_if(source.sites, [&](std::size_t known) {
        return std::ranges::find(sites, known) == sites.end();
      });
    }
    open = std::move(others);
    sources.push_back(std::move(source));
  }
  return sources;
}

}  // namespace

bool LinePushes::are_explained() const {
  const SitePush& best = sites.front();
  const auto chosen_among = static_cast<double>(sites.size());
  return best.share > most_of_it && best.p_value * chosen_among < chance;
}

Pushes find_pushes(const std::vector<PushedLine>& lines,
                   const std::vector<ResidualCluster>& found) {
  std::vector<Group> groups = groups_of(lines, found);
  std::erase_if(groups, [](const Group& group) {
    return Eigen::Index(group.size()) <= 2 * laws_of(group).cols();
  });
  std::ranges::stable_sort(groups, std::ranges::greater{},
                           [](const Group& group) { return squares_before(group).sum(); });
  Pushes pushes;
  for (const Group& group : groups) pushes.lines.push_back(explained(group));
  pushes.sources = sources_of(pushes.lines);
  return pushes;
}

}  // namespace rvbench::analysis
