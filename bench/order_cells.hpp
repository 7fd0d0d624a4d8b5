#pragma once

#include <vector>

#include "bench/order_campaign.hpp"
#include "bench/order_errors.hpp"
#include "bench/twin.hpp"

namespace rvbench::bench {

/// What records of steady turning differ from the expected by, condition by condition, and the
/// noise that they have.
/// @param expected  of each condition's features; empty if the plant cannot show them: no cells
Twin::Cells order_cells(const std::vector<sim::OutputSpec>& outputs, const OrderCampaign& seen,
                        const OrderScatter& scatter, const std::vector<Eigen::VectorXd>& expected);

}  // namespace rvbench::bench
