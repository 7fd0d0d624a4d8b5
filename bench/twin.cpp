#include "bench/twin.hpp"

#include <cmath>

#include "bench/order_twin.hpp"
#include "bench/time_twin.hpp"

namespace rvbench::bench {

double Twin::Comparison::error() const {
  return std::sqrt((measured - simulated).squaredNorm() / static_cast<double>(measured.size()));
}

double Twin::Comparison::relative_error() const {
  return (measured - simulated).norm() / measured.norm();
}

TwinOrRefusal make_twin(sim::PlantSpec plant, const Campaign& campaign,
                        const sim::TermLibrary& library) {
  const bool by_orders =
      !plant.outputs.empty() && plant.outputs.front().compared_by == sim::ComparedBy::orders;
  return by_orders ? OrderTwin::make(std::move(plant), campaign, library)
                   : TimeTwin::make(std::move(plant), campaign, library);
}

}  // namespace rvbench::bench
