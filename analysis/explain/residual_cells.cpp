#include "analysis/explain/residual_cells.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "analysis/statistics.hpp"

namespace rvbench::analysis {
namespace {

constexpr double freedom = 42;  // of errors that are pooled over 21 conditions of three records

double p_value_of(const ResidualCell& cell) {
  return t_p_value(cell.apart / cell.standard_error, freedom);
}

std::vector<std::size_t> ascending(const std::vector<double>& p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return p_values[i]; });
  return order;
}

// Of all of them together.
double simes(const std::vector<double>& p_values) {
  const std::vector<std::size_t> order = ascending(p_values);
  const auto n = static_cast<double>(p_values.size());
  double least = 1;
  for (std::size_t i = 0; i < order.size(); ++i) {
    least = std::min(least, p_values[order[i]] * n / static_cast<double>(i + 1));
  }
  return least;
}

using Cells = std::vector<const ResidualCell*>;

std::vector<double> p_values_of(const Cells& cells) {
  std::vector<double> p_values;
  for (const ResidualCell* cell : cells) p_values.push_back(p_value_of(*cell));
  return p_values;
}

// Times of different programmes have nothing to do with each other.
std::vector<Cells> families_of(const std::vector<ResidualCell>& cells) {
  std::map<std::tuple<std::string, LockedTo, std::string>, Cells> families;
  for (const ResidualCell& cell : cells) {
    const bool has_own_time = cell.locked_to == LockedTo::programme;
    families[{cell.channel, cell.locked_to, has_own_time ? cell.condition : ""}].push_back(&cell);
  }
  std::vector<Cells> all;
  for (auto& [key, family] : families) all.push_back(std::move(family));
  return all;
}

// Of cells beside each other.
ResidualCluster cluster_of(const Cells& cells) {
  const ResidualCell& first = *cells.front();
  ResidualCluster cluster{
      first.channel, first.unit, first.locked_to, first.place, cells.back()->place, {}, 0, 0};
  cluster.is_new = std::ranges::all_of(cells, &ResidualCell::is_new);
  std::map<std::string, double> most;
  for (const ResidualCell* cell : cells) {
    if (most.try_emplace(cell->condition).second) cluster.conditions.push_back(cell->condition);
    const double standard_errors = cell->apart / cell->standard_error;
    most[cell->condition] = std::max(most[cell->condition], std::abs(standard_errors));
    if (std::abs(standard_errors) > std::abs(cluster.standard_errors)) {
      cluster.apart = cell->apart;
      cluster.standard_errors = standard_errors;
    }
  }
  for (const auto& [condition, errors] : most) {
    cluster.together = std::hypot(cluster.together, errors);
  }
  return cluster;
}

// Of one family, in order of their places.
std::vector<ResidualCluster> gathered(Cells found, double beside) {
  std::ranges::stable_sort(found, {}, &ResidualCell::place);
  std::vector<ResidualCluster> clusters;
  for (auto from = found.begin(); from != found.end();) {
    const auto to = std::adjacent_find(from, found.end(), [&](const auto* one, const auto* next) {
      return next->place - one->place > beside;
    });
    const auto end = to == found.end() ? to : to + 1;
    clusters.push_back(cluster_of(Cells(from, end)));
    from = end;
  }
  return clusters;
}

}  // namespace

const char* to_string(LockedTo locked) noexcept {
  switch (locked) {
    case LockedTo::nothing: return "mean";
    case LockedTo::shaft: return "order";
    case LockedTo::time: return "Hz";
    case LockedTo::programme: return "s";
  }
  return "";
}

std::vector<bool> discoveries(const std::vector<double>& p_values, double q) {
  const std::vector<std::size_t> order = ascending(p_values);
  const auto n = static_cast<double>(p_values.size());
  std::size_t rejected = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (p_values[order[i]] <= q * static_cast<double>(i + 1) / n) rejected = i + 1;
  }
  std::vector<bool> result(p_values.size(), false);
  for (std::size_t i = 0; i < rejected; ++i) result[order[i]] = true;
  return result;
}

std::vector<ResidualCluster> locate(const std::vector<ResidualCell>& cells, double beside,
                                    double q) {
  const std::vector<Cells> families = families_of(cells);
  std::vector<double> of_families;
  for (const Cells& family : families) of_families.push_back(simes(p_values_of(family)));
  const std::vector<bool> differs = discoveries(of_families, q);
  std::vector<ResidualCluster> all;
  for (std::size_t f = 0; f < families.size(); ++f) {
    if (!differs[f]) continue;
    const std::vector<bool> is_off = discoveries(p_values_of(families[f]), q);
    Cells found;
    for (std::size_t i = 0; i < is_off.size(); ++i) {
      if (is_off[i]) found.push_back(families[f][i]);
    }
    for (ResidualCluster& cluster : gathered(std::move(found), beside)) {
      all.push_back(std::move(cluster));
    }
  }
  std::ranges::stable_sort(all, std::ranges::greater{}, [](const ResidualCluster& cluster) {
    return std::abs(cluster.standard_errors);
  });
  return all;
}

}  // namespace rvbench::analysis
