#include "bench/same_recording.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::bench {
namespace {

using analysis::ChannelExamination;

// Two recordings of one machine differ by some thousandths in each; samples with six digits by some
// millionths.
bool is_near(double one, double other) {
  constexpr double same = 1e-5;  // relative
  return std::abs(one - other) <= same * std::abs(one);
}

bool has_same_samples(const ChannelExamination& one, const ChannelExamination& other) {
  return one.rms > 0 && is_near(one.rms, other.rms) && is_near(one.peak, other.peak) &&
         is_near(one.kurtosis, other.kurtosis);
}

}  // namespace

bool are_of_one_recording(const JudgedPoint& one, const JudgedPoint& other) {
  const auto& fewer = one.examination.channels.size() <= other.examination.channels.size()
                          ? one.examination.channels
                          : other.examination.channels;
  const auto& more =
      &fewer == &one.examination.channels ? other.examination.channels : one.examination.channels;
  const auto same = std::ranges::count_if(fewer, [&](const ChannelExamination& channel) {
    return std::ranges::any_of(
        more, [&](const ChannelExamination& its) { return has_same_samples(channel, its); });
  });
  return 2 * same > std::ssize(fewer);
}

bool share_a_recording(const Judgement& one, const Judgement& other) {
  return std::ranges::any_of(one.points, [&](const JudgedPoint& point) {
    return std::ranges::any_of(
        other.points, [&](const JudgedPoint& its) { return are_of_one_recording(point, its); });
  });
}

}  // namespace rvbench::bench
