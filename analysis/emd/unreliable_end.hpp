#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace rvbench::analysis {

/// So many samples at either end of an IMF are not to be relied on: see Emd::unreliable_ends.
/// @param samples  of the signal
/// @param extrema  that the last sift found
/// @param sifts    there were, at least 1
/// @return samples, at most as many as there are. Errors  none thrown
/// Source  ours: measured on white noise and gear signals, 1 to 40 sifts
Eigen::Index unreliable_end(Eigen::Index samples, std::size_t extrema, std::size_t sifts);

/// One more IMF, of what the IMFs before have left: no more of it is reliable than of them.
/// @param own  of its own sifts
/// Units, errors, source  of unreliable_end()
void add_unreliable_end(std::vector<Eigen::Index>& ends, Eigen::Index own);

}  // namespace rvbench::analysis
