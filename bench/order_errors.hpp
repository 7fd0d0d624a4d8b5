#pragma once

#include <vector>

#include "bench/order_records.hpp"

namespace rvbench::bench {

inline constexpr double clearly_above_noise = 4;  ///< rms amplitudes: by chance 1 in 10 million

/// Values and noise of a record's features.
void read_features(const OrderCondition& condition, OrderRecord& record);

/// Standard errors of all records' values: what repeats of a condition differ by, pooled over all
/// conditions (of means their scatter, of lines the part that grows with them), and the noise
/// beside each line.
/// @param outputs  how many the plant has
void find_errors(const std::vector<OrderCondition>& conditions, std::size_t outputs,
                 std::vector<OrderRecord>& records);

}  // namespace rvbench::bench
