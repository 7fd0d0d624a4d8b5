#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/explain/period_lines.hpp"
#include "bench/order_features.hpp"
#include "bench/twin.hpp"
#include "sim/steady_state.hpp"

namespace rvbench::bench {

/// Constant inputs that records share, how the plant turns under them as it is, and what its
/// records are compared by.
struct OrderCondition {
  Eigen::VectorXd inputs;
  sim::SteadyState nominal;
  std::vector<int> orders;  ///< highest that each output shows in all of its records
  std::vector<OrderFeature> features;
  double length_s = 0;     ///< of its first record
  double speed_share = 1;  ///< of the nominal state's: what records that are learned from show
};

struct OrderRecord {
  RecordLabels about;
  std::size_t condition = 0;
  OrderMeasurement measured;
  std::vector<analysis::TimedLine> timed;  ///< see timed_lines()
  Eigen::VectorXd values, noise, errors;   ///< of the condition's features
  double speed_share = 1;                  ///< of the condition's nominal speed
};

}  // namespace rvbench::bench
