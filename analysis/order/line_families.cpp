#include "analysis/order/line_families.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <unsupported/Eigen/SpecialFunctions>
#include <utility>

#include "analysis/diagnosis.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

constexpr std::size_t fewest_pairs = 3;
constexpr double tolerances = 20;     // to each side of a spacing, that tell what chance makes
constexpr int most_sidebands = 3;     // of a known spacing
constexpr int most_multiples = 6;     // of a spacing, that are no new one
constexpr double as_many = 0.75;      // of the pairs of a spacing, that a part of it must have
constexpr double errors_allowed = 3;  // standard errors

using Pair = std::pair<std::size_t, std::size_t>;

void check(const std::vector<FamilyLine>& lines, const FamilySearch& search) {
  constexpr Require require{"line_families"};
  require(search.near > 0, "near must be above 0");
  require(search.smallest_spacing >= 4 * search.near, "smallest_spacing must be 4 times near");
  require(search.largest_spacing > search.smallest_spacing, "spacings must be in order");
  for (const FamilyLine& line : lines) {
    require(std::isfinite(line.order) && line.order > 0, "an order is not finite or not above 0");
  }
}

bool is_multiple(double spacing, double of, double within) {
  const double k = std::round(spacing / of);
  return k >= 1 && k <= most_multiples && std::abs(spacing - k * of) <= k * within;
}

// The lines in rising order, with order 0 before them; and which pairs of them still count.
class Lines {
 public:
  Lines(const std::vector<FamilyLine>& lines, const FamilySearch& search)
      : near_(search.near), known_(search.known_spacings.size()), spacings_(search.known_spacings) {
    index_.resize(lines.size());
    std::iota(index_.begin(), index_.end(), std::size_t{0});
    std::ranges::sort(index_, std::less<>(), [&](std::size_t i) { return lines[i].order; });
    lines_ = {{0, 0, true}};
    for (const std::size_t i : index_) lines_.push_back(lines[i]);
    explain_known();
  }

  std::size_t size() const { return lines_.size(); }
  const FamilyLine& operator[](std::size_t i) const { return lines_[i]; }
  std::size_t listed(std::size_t i) const { return index_[i - 1]; }
  void explain(std::size_t i) { lines_[i].explained = true; }

  std::span<const double> found() const { return std::span(spacings_).subspan(known_); }

  // From now on, what lies a spacing away from a line that is explained is explained, too.
  void know(double spacing) {
    spacings_.push_back(spacing);
    explain_known();
  }
  bool is_known(double spacing) const {
    return std::ranges::any_of(
        spacings_, [&](double known) { return is_multiple(spacing, known, 2 * near_); });
  }

  // Sidebands, of spacings that are known, of lines that are explained.
  void explain_known() {
    for (bool more = true; more;) {
      more = false;
      for (std::size_t i = 1; i < lines_.size(); ++i) {
        if (lines_[i].explained || !is_known_sideband(i)) continue;
        lines_[i].explained = more = true;
      }
    }
  }

  // Pairs that are `spacing` apart, within so much.
  std::vector<Pair> pairs(double spacing, double within) const {
    std::vector<Pair> found;
    std::size_t from = 0;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      while (from < lines_.size() && lines_[from].order < lines_[i].order + spacing - within) {
        ++from;
      }
      for (std::size_t k = std::max(from, i + 1); k < lines_.size(); ++k) {
        if (lines_[k].order > lines_[i].order + spacing + within) break;
        if (!lines_[i].explained || !lines_[k].explained) found.emplace_back(i, k);
      }
    }
    return found;
  }

 private:
  bool is_known_sideband(std::size_t line) const {
    for (std::size_t i = 1; i < lines_.size(); ++i) {
      if (!lines_[i].explained) continue;
      const double away = std::abs(lines_[line].order - lines_[i].order);
      for (const double known : spacings_) {
        const auto k = std::lround(away / known);
        if (k >= 1 && k <= most_sidebands &&
            std::abs(away - static_cast<double>(k) * known) <= 2 * near_) {
          return true;
        }
      }
    }
    return false;
  }

  double near_;
  std::size_t known_;             // of the spacings, the first ones
  std::vector<double> spacings_;  // known, then found
  std::vector<FamilyLine> lines_;
  std::vector<std::size_t> index_;
};

// Spacings worth a try: those of all pairs that count.
std::vector<double> spacings_of(const Lines& lines, const FamilySearch& search) {
  std::vector<double> spacings;
  const double middle = 0.5 * (search.smallest_spacing + search.largest_spacing);
  for (const auto& [i, k] : lines.pairs(middle, search.largest_spacing - middle)) {
    const double spacing = lines[k].order - lines[i].order;
    if (!lines.is_known(spacing)) spacings.push_back(spacing);
  }
  return spacings;
}

// Pairs that chance alone puts at a spacing, within the tolerance.
double expected_pairs(const Lines& lines, double spacing, double within, std::size_t there) {
  const double around = std::min(tolerances * within, 0.5 * spacing);
  const auto nearby =
      static_cast<double>(lines.pairs(spacing, around).size() - there) * within / (around - within);
  const auto n = static_cast<double>(lines.size());
  const double span = lines[lines.size() - 1].order;
  return std::max(nearby, 2 * n * n * within / span * (1 - std::min(1.0, spacing / span)));
}

struct Candidate {
  double spacing = 0;
  double p_value = 1;
  std::vector<Pair> pairs;
};

// @param tried  spacings, of which this is one
Candidate candidate_at(const Lines& lines, double spacing, double within, double tried) {
  Candidate candidate{spacing, 1, lines.pairs(spacing, within)};
  if (candidate.pairs.size() < fewest_pairs) return candidate;
  // The pair that suggested the spacing is there by construction.
  const auto count = static_cast<double>(candidate.pairs.size() - 1);
  const double expected = expected_pairs(lines, spacing, within, candidate.pairs.size());
  candidate.p_value = std::min(1.0, Eigen::numext::igamma(count, expected) * tried);
  return candidate;
}

// Twice a spacing has pairs wherever the spacing itself has, and so has its sum with a spacing that
// was found; the parts have none by chance. The finest of them that has about as many, and is
// significant, too.
std::optional<Candidate> finer_than(const Candidate& coarse, const Lines& lines,
                                    const FamilySearch& search, double tried) {
  std::vector<double> spacings;
  for (int k = 2; k <= most_multiples; ++k) spacings.push_back(coarse.spacing / k);
  for (const double found : lines.found()) {
    for (int k = 1; k <= most_multiples; ++k) {
      const double apart = std::abs(coarse.spacing - k * found);
      if (apart < coarse.spacing - 2 * search.near) spacings.push_back(apart);
    }
  }
  std::ranges::sort(spacings);
  for (const double spacing : spacings) {
    if (spacing < search.smallest_spacing || lines.is_known(spacing)) continue;
    Candidate finer = candidate_at(lines, spacing, 2 * search.near, tried);
    const auto pairs = static_cast<double>(coarse.pairs.size());
    if (finer.p_value < significant_p && double(finer.pairs.size()) >= as_many * pairs) {
      return finer;
    }
  }
  return std::nullopt;
}

std::optional<Candidate> surest(const Lines& lines, const FamilySearch& search) {
  const std::vector<double> spacings = spacings_of(lines, search);
  const auto tried = static_cast<double>(spacings.size());
  const double within = 2 * search.near;
  Candidate best;
  for (const double spacing : spacings) {
    Candidate next = candidate_at(lines, spacing, within, tried);
    if (next.p_value < best.p_value) best = std::move(next);
  }
  if (best.p_value >= significant_p) return std::nullopt;
  while (auto finer = finer_than(best, lines, search, tried)) best = *std::move(finer);
  return best;
}

// Lines that pairs join, each chain with how many spacings each is away from its first.
struct Chain {
  std::vector<std::size_t> lines;
  std::vector<int> steps;
};

std::vector<Chain> chains_of(const std::vector<Pair>& pairs) {
  std::vector<Chain> chains;
  for (const auto& [i, k] : pairs) {  // in rising order of i
    const auto chain = std::ranges::find_if(
        chains, [&, from = i](const Chain& c) { return std::ranges::count(c.lines, from) > 0; });
    if (chain == chains.end()) {
      chains.push_back({{i, k}, {0, 1}});
    } else if (std::ranges::count(chain->lines, k) == 0) {
      const auto at = std::ranges::find(chain->lines, i) - chain->lines.begin();
      chain->steps.push_back(chain->steps[static_cast<std::size_t>(at)] + 1);
      chain->lines.push_back(k);
    }
  }
  return chains;
}

// Least squares of one spacing through all chains, each with a start of its own.
void fit_spacing(const Lines& lines, const std::vector<Chain>& chains, double near,
                 LineFamily& family) {
  double up = 0, steps2 = 0, misfit2 = 0, freedom = -1;
  const auto each = [&](auto use) {
    for (const Chain& chain : chains) {
      const auto n = static_cast<double>(chain.lines.size());
      double order = 0, step = 0;
      for (std::size_t m = 0; m < chain.lines.size(); ++m) {
        order += lines[chain.lines[m]].order / n;
        step += chain.steps[m] / n;
      }
      for (std::size_t m = 0; m < chain.lines.size(); ++m) {
        use(chain.steps[m] - step, lines[chain.lines[m]].order - order);
      }
      freedom += n - 1;
    }
  };
  each([&](double step, double order) {
    up += step * order;
    steps2 += step * step;
  });
  family.spacing = up / steps2;
  each([&](double step, double order) { misfit2 += std::pow(order - step * family.spacing, 2); });
  const double sigma = freedom / 2 > 1 ? std::sqrt(misfit2 / (freedom / 2)) : near;
  family.spacing_error = std::max(sigma, 0.05 * near) / std::sqrt(steps2);
}

// Which multiple of the spacing an order is; 0: none.
int harmonic_of(double order, const LineFamily& family, double near) {
  const double multiple = std::round(order / family.spacing);
  const double off = std::abs(order - multiple * family.spacing);
  const bool on = off <= near + errors_allowed * multiple * family.spacing_error;
  return on && multiple * family.spacing_error * errors_allowed < 0.1 * family.spacing
             ? static_cast<int>(multiple)
             : 0;
}

std::size_t carrier_of(const Lines& lines, const Chain& chain) {
  return *std::ranges::max_element(chain.lines, std::less<>(), [&](std::size_t i) {
    return std::pair(lines[i].explained, lines[i].amplitude);
  });
}

LineFamily family_of(Lines& lines, const Candidate& candidate, const FamilySearch& search) {
  LineFamily family;
  family.p_value = candidate.p_value;
  const std::vector<Chain> chains = chains_of(candidate.pairs);
  fit_spacing(lines, chains, search.near, family);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const int multiple = harmonic_of(lines[i].order, family, search.near);
    if (multiple == 0 || lines[i].explained) continue;
    family.harmonics.push_back({lines.listed(i), lines.listed(i), multiple});
    lines.explain(i);
  }
  for (const Chain& chain : chains) {
    const std::size_t carrier = carrier_of(lines, chain);
    if (carrier == 0 || harmonic_of(lines[carrier].order, family, search.near) > 0) continue;
    const auto at = std::ranges::find(chain.lines, carrier) - chain.lines.begin();
    for (std::size_t m = 0; m < chain.lines.size(); ++m) {
      family.sidebands.push_back({lines.listed(chain.lines[m]), lines.listed(carrier),
                                  chain.steps[m] - chain.steps[static_cast<std::size_t>(at)]});
    }
  }
  lines.know(family.spacing);
  return family;
}

}  // namespace

std::vector<LineFamily> line_families(const std::vector<FamilyLine>& lines,
                                      const FamilySearch& search) {
  check(lines, search);
  Lines sorted(lines, search);
  std::vector<LineFamily> families;
  if (lines.size() < fewest_pairs) return families;
  while (const auto candidate = surest(sorted, search)) {
    families.push_back(family_of(sorted, *candidate, search));
  }
  return families;
}

}  // namespace rvbench::analysis
