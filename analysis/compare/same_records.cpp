#include "analysis/compare/same_records.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

// Lines that are above either band are known of neither.
bool agree(const Level& a, const Level& b) {
  return a.whole_dB == b.whole_dB || (std::isnan(a.whole_dB) && std::isnan(b.whole_dB));
}

bool is_same(const RecordLevels& a, const RecordLevels& b) {
  const auto same_channel = [](const ChannelLevels& one, const ChannelLevels& other) {
    return std::ranges::equal(one.levels, other.levels, agree);
  };
  return !a.channels.empty() && std::ranges::equal(a.channels, b.channels, same_channel);
}

}  // namespace

std::vector<SameRecord> same_records(const std::vector<RecordLevels>& a,
                                     const std::vector<RecordLevels>& b) {
  std::vector<SameRecord> same;
  for (std::size_t j = 0; j < b.size(); ++j) {
    const auto twin = std::ranges::find_if(a, [&](const auto& one) { return is_same(one, b[j]); });
    if (twin != a.end()) same.push_back({static_cast<std::size_t>(twin - a.begin()), j});
  }
  return same;
}

}  // namespace rvbench::analysis
