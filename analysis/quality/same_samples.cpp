#include "analysis/quality/same_samples.hpp"

#include <algorithm>

namespace rvbench::analysis {
namespace {

bool same(const Channel& a, const Channel& b) {
  return a.samples.size() > 0 && a.rate_Hz == b.rate_Hz && std::ranges::equal(a.samples, b.samples);
}

}  // namespace

std::vector<std::size_t> first_of_same(const std::vector<const Channel*>& channels) {
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::size_t k = 0;
    while (k < i && !same(*channels[k], *channels[i])) ++k;
    first.push_back(k);
  }
  return first;
}

}  // namespace rvbench::analysis
