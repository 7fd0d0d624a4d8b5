#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace rvbench::analysis {

/// Extrema in the order of time, through which the two envelopes go: every second one belongs to
/// the same. Those that are done with are dropped from the front.
///
/// Errors  none thrown: who lays or drops more than there is room for, or are, has a bug
/// Source  ours: one list for both envelopes, so that they are gone through once
struct Knots {
  std::vector<double> at;     ///< in samples; half-integer at the middle of an even plateau
  std::vector<double> value;  ///< of the signal there
  std::size_t first = 0;      ///< where the first one is
  std::size_t end = 0;        ///< past the last one; what follows is room for more

  std::size_t size() const { return end - first; }

  /// Leaves room for so many before the first one. Nothing is left of what was there.
  void clear(std::size_t room_before) {
    first = end = room_before;
    make_room(0);
  }
  void make_room(std::size_t more) {
    if (at.size() >= end + more) return;
    const std::size_t size = std::max(end + more, 2 * at.size());
    at.resize(size);
    value.resize(size);
  }
  void push_front(double where, double what) {
    --first;
    at[first] = where;
    value[first] = what;
  }
  void push_back(double where, double what) {
    make_room(1);
    at[end] = where;
    value[end] = what;
    ++end;
  }
  void rebase(double samples) {
    for (std::size_t j = first; j < end; ++j) at[j] -= samples;
  }
  /// Those before `keep` are gone, and it is number 0.
  void drop_before(std::size_t keep) {
    for (auto* each : {&at, &value}) std::copy(&(*each)[keep], &(*each)[end], each->data());
    first = 0;
    end -= keep;
  }
};

}  // namespace rvbench::analysis
