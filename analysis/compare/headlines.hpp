#pragma once

#include <cstddef>
#include <vector>

#include "analysis/compare/comparison.hpp"

namespace rvbench::analysis {

/// All changes of one quantity, over points and channels. Lines count where they are seen.
struct Headline {
  std::size_t quantity = 0;
  std::size_t compared = 0;      ///< cells, points times channels, that are seen
  std::size_t changed = 0;       ///< of these
  double median_dB = not_known;  ///< of those changed
  double least_dB = not_known, most_dB = not_known;  ///< likewise
  std::size_t strongest = 0;  ///< index into Comparison::changes: the largest change
  std::size_t points = 0;     ///< that show a change
};

/// Of all quantities that changed somewhere, those with the most of it first: cells times dB.
/// Shape   at most one per quantity. Units  dB. Errors  none thrown. Source  ours
std::vector<Headline> headlines(const Comparison& comparison);

/// Lines of one signature of the kinematics, over points and channels.
struct FamilyHeadline {
  std::size_t family = 0;        ///< index into Kinematics::signatures
  std::size_t cells = 0;         ///< lines times points times channels, seen or not, also taken
  std::size_t changed = 0;       ///< of these, seen and changed
  double median_dB = not_known;  ///< of those changed
  double least_dB = not_known, most_dB = not_known;  ///< likewise
  std::vector<std::size_t> or_of = {};  ///< other signatures whose lines these may as well be

  double share() const { return static_cast<double>(changed) / static_cast<double>(cells); }
};

/// Of all signatures that have a line that changed, first the one of whose lines most changed and
/// most strongly: share, by the rule of succession, times dB, up to 10 dB. Parts share lines: what
/// the first explains others have as well. What cannot be told from an earlier one is named there.
/// Shape   at most one per signature. Units  dB. Errors  none thrown
/// Source  ours; rule of succession, (k + 1)/(n + 2): Laplace, Essai philosophique sur les
///         probabilités (1814)
std::vector<FamilyHeadline> family_headlines(const Comparison& comparison);

/// Cells by their word; lines that are not seen are counted apart.
struct ChangeCounts {
  std::size_t changed = 0, not_changed = 0, cannot_tell = 0;
  std::size_t noise_changed = 0;            ///< at places of lines that are not seen
  double median_detectable_dB = not_known;  ///< of those not changed
};

/// Units  dB. Errors  none thrown. Source  ours
ChangeCounts counts_of(const Comparison& comparison);

/// Changed if a cell is; else not changed if that can be told of half of the cells at least.
/// Errors  none thrown. Source  ours
ChangeWord word_of(const ChangeCounts& counts);

}  // namespace rvbench::analysis
