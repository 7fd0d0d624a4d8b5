#pragma once

#include <vector>

#include "bench/order_records.hpp"
#include "bench/pushed_features.hpp"
#include "sim/plant_spec.hpp"
#include "sim/term_library.hpp"

namespace rvbench::bench {

/// The shaft whose angle orders are told by.
struct ReferenceShaft {
  std::size_t output = 0;   ///< that is its angle
  int body = 0;             ///< that it is the angle of
  double period_turns = 0;  ///< of that body
};

/// What records that are learned from show beside a plant, and how the plant answers forces. The
/// transducer is the first torque between two bodies that turn alike, if a constant force on any
/// body reaches it from one side only. Its mean is the load.
///
/// @param states  of the plant, one for each condition
PushedFeatures order_pushes(const sim::PlantSpec& plant, const sim::TermLibrary& library,
                            const std::vector<OrderCondition>& conditions,
                            const std::vector<OrderRecord>& records,
                            const std::vector<sim::SteadyState>& states,
                            const ReferenceShaft& shaft);

}  // namespace rvbench::bench
