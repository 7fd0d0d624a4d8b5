#include "bench/twin.hpp"

#include <cmath>

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
  return TimeTwin::make(std::move(plant), campaign, library);
}

}  // namespace rvbench::bench
