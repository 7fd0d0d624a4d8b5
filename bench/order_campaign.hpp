#pragma once

#include <variant>
#include <vector>

#include "bench/order_records.hpp"
#include "sim/term_library.hpp"

namespace rvbench::bench {

/// Records of a steadily turning plant, sorted by the inputs that they share.
struct OrderCampaign {
  std::size_t angle = 0;    ///< output that is the reference shaft's angle
  int turning = 0;          ///< body that it is the angle of
  double period_turns = 0;  ///< of that body
  std::vector<OrderCondition> conditions;
  std::vector<OrderRecord> records;  ///< their values are yet to be chosen
};

/// Measures a campaign's records by orders, and solves the plant as it is under each condition.
/// @return why plant and recordings do not fit: all faults of recordings at once
std::variant<OrderCampaign, Refusal> order_campaign(const sim::PlantSpec& plant,
                                                    const Campaign& campaign,
                                                    const sim::TermLibrary& library);

}  // namespace rvbench::bench
