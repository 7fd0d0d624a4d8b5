#include "sim/period_orders.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace rvbench::sim {
namespace {

constexpr double samples_per_line = 2.4;  // at least: more than the lines need, against aliasing
constexpr double fewest_samples = 64;
constexpr int few = 64;  // multiples of a lattice: all are taken

int common_divisor(const std::set<int>& orders) {
  return std::accumulate(orders.begin(), orders.end(), 0,
                         [](int all, int order) { return std::gcd(all, order); });
}

void add_both_ways(std::set<int>& to, const std::set<int>& orders) {
  for (const int order : orders) to.insert({order, -order});
}

// What there is of all orders of a period, with both signs: a lattice, and others beside it.
struct Parted {
  int lattice = 0;       // its first order; 0 if there is none
  int highest = 0;       // that a push of the lattice has
  std::set<int> others;  // 0 among them
};

// Terms of many orders come first. A term's orders stand beside the lattice where a finer one, that
// holds them too, has many lines, and more than that.
Parted parted(std::vector<std::set<int>> pushes, int highest) {
  std::erase_if(pushes, [](const std::set<int>& push) { return push.empty(); });
  std::ranges::stable_sort(pushes, std::ranges::greater{}, [](const std::set<int>& push) {
    return std::pair(push.size(), common_divisor(push));
  });
  Parted result{0, 0, {0}};
  for (const std::set<int>& push : pushes) {
    const int finer = std::gcd(result.lattice, common_divisor(push));
    const int multiples = highest / finer;
    const std::size_t lines_of_finer = std::size_t(multiples) * result.others.size();
    const std::size_t lines_beside = std::size_t(highest / std::max(result.lattice, 1)) *
                                     (result.others.size() + 2 * push.size());
    if (result.lattice == 0 || multiples <= few || lines_of_finer <= lines_beside) {
      result.lattice = finer;
      result.highest = std::max(result.highest, *push.rbegin());
    } else {
      add_both_ways(result.others, push);
    }
  }
  return result;
}

// All sums of one of the lattice's multiples or of the others, and one of the others.
// @return ascending
std::vector<int> sums_of(const Parted& parts, int highest) {
  std::vector<int> first(parts.others.begin(), parts.others.end());
  for (int order = parts.lattice; order > 0 && order <= highest; order += parts.lattice) {
    first.insert(first.end(), {order, -order});
  }
  std::vector<int> sums;
  sums.reserve(first.size() * parts.others.size());
  for (const int other : parts.others) {
    for (const int order : first) sums.push_back(order + other);
  }
  std::ranges::sort(sums);
  sums.erase(std::unique(sums.begin(), sums.end()), sums.end());
  return sums;
}

// FFTW has small transforms of its own for these factors.
bool is_quick_to_transform(int samples) {
  for (const int factor : {2, 3, 5, 7, 11, 13}) {
    while (samples % factor == 0) samples /= factor;
  }
  return samples == 1;
}

// Asks how often a period must be sampled.
class Samples {
 public:
  // @param orders  to be told from the mean, from each other and from the others
  Samples(const std::vector<int>& orders, std::vector<int> others)
      : orders_(orders), others_(std::move(others)) {}

  int fewest(int at_least) {
    while (!is_quick_to_transform(at_least) || !are_enough(at_least)) ++at_least;
    return at_least;
  }

 private:
  // Whether each of the orders falls on a place of its own: on none that any other, its own other
  // sign or the mean falls on.
  bool are_enough(int samples) {
    taken_.assign(static_cast<std::size_t>(samples), false);
    taken_[0] = true;
    for (const int order : orders_) {
      for (const int sign : {1, -1}) {
        const std::size_t at = place(sign * order, samples);
        if (taken_[at]) return false;
        taken_[at] = true;
      }
    }
    return std::ranges::none_of(others_, [&](int order) { return taken_[place(order, samples)]; });
  }

  static std::size_t place(int order, int samples) {
    const int rest = order % samples;
    return static_cast<std::size_t>(rest < 0 ? rest + samples : rest);
  }

  const std::vector<int>& orders_;
  std::vector<int> others_;
  std::vector<char> taken_;
};

}  // namespace

PeriodOrders::PeriodOrders(const std::vector<std::set<int>>& pushes, int highest)
    : highest_(highest) {
  const Parted parts = parted(pushes, highest);
  for (const int order : sums_of(parts, highest)) {
    if (order > 0 && order <= highest) orders_.push_back(order);
  }
  // What the lattice's own pushes bring, its lines change once more.
  std::vector<int> others = sums_of(parts, highest + parts.highest);
  std::erase_if(others, [&](int order) {
    return order == 0 || std::ranges::binary_search(orders_, std::abs(order));
  });
  const double least = std::max(samples_per_line * double(orders_.size()), fewest_samples);
  samples_ = Samples(orders_, std::move(others)).fewest(static_cast<int>(std::ceil(least)));
}

}  // namespace rvbench::sim
