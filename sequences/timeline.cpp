#include "sequences/timeline.hpp"

#include <algorithm>
#include <iterator>

namespace rvbench::sequences {

std::vector<Segment> timeline(const TestPlan& plan) {
  std::vector<Segment> segments;
  for (const auto* stage : {&plan.setup, &plan.main}) {
    for (const auto& phase : *stage) {
      std::ranges::copy(phase->timeline(plan.specimen), std::back_inserter(segments));
    }
  }
  return segments;
}

double planned_duration_s(const TestPlan& plan) {
  double total_s = 0;
  for (const Segment& segment : timeline(plan)) total_s += segment.duration_s;
  return total_s;
}

}  // namespace rvbench::sequences
