#pragma once

#include <vector>

#include "bench/order_records.hpp"

namespace rvbench::bench {

inline constexpr double clearly_above_noise = 4;  ///< rms amplitudes: by chance 1 in 10 million

/// Of the strongest line of its output: aliases and harmonics that a good measuring chain shows.
inline constexpr double least_of_strongest = 1e-4;

/// A condition's records that say what it shows: those that are learned from; all of them where
/// none is.
std::vector<const OrderRecord*> telling_of(std::size_t condition,
                                           const std::vector<OrderRecord>& records);

/// Values and noise of a record's features.
void read_features(const OrderCondition& condition, OrderRecord& record);

/// What the record would show on average of such features, noise included.
/// @param features  of its condition, without noise
Eigen::VectorXd shown_by(Eigen::VectorXd features, const OrderCondition& condition,
                         const OrderRecord& record);

/// What records of one condition differ by: the parts that their errors are made of.
struct OrderScatter {
  std::vector<double> of_means;      ///< per output, in its unit; NaN: nothing is repeated
  double of_lines = not_known;       ///< share of a line, the same for all; NaN likewise
  std::vector<double> beside_lines;  ///< per output: of a line's amplitude, by noise alone
};

/// Variance components of the records that are learned from: repeats are pooled over all
/// conditions, and of lines the noise beside them is taken from what repeats differ by.
/// @param outputs  how many the plant has
OrderScatter scatter_of(const std::vector<OrderCondition>& conditions, std::size_t outputs,
                        const std::vector<OrderRecord>& records);

/// Standard errors of all records' values. A mean has that of its output, a line the share that
/// lines differ by and the noise beside it. To both comes what a plant is good for, and to a line
/// what aliases and harmonics of a good measuring chain are, 80 dB below the strongest: these are
/// the same in all repeats, which together tell no more of them than one record would.
void find_errors(const std::vector<OrderCondition>& conditions, const OrderScatter& scatter,
                 std::vector<OrderRecord>& records);

}  // namespace rvbench::bench
