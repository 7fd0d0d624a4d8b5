#pragma once

#include <vector>

#include "analysis/explain/residual_cells.hpp"
#include "bench/order_campaign.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// Lines that turn with the machine and do not repeat with it: a bearing's, or of a part that
/// slips. The plant shows none. Between its orders a Hann window passes nothing that repeats; those
/// are told that stand clear of noise there again and again, under all conditions.
std::vector<analysis::ResidualCell> cells_between_orders(const sim::PlantSpec& plant,
                                                         const OrderCampaign& seen);

}  // namespace rvbench::bench
