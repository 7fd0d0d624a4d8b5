#include "bench/twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/envelope_twin.hpp"
#include "bench/order_twin.hpp"
#include "bench/time_twin.hpp"

namespace rvbench::bench {
namespace {

// What is wrong with several records alike is said once.
Refusal told_once(Refusal refusal, const Campaign& campaign) {
  struct Told {
    hal::ConfigFault fault;
    std::string first;
    std::size_t records = 0;
  };
  std::vector<Told> all;
  for (hal::ConfigFault& fault : refusal.faults) {
    const auto of = std::ranges::find_if(campaign.records, [&](const CampaignRecord& record) {
      return fault.message.starts_with(record.name + ": ");
    });
    const std::string record = of == campaign.records.end() ? "" : of->name;
    if (!record.empty()) fault.message.erase(0, record.size() + 2);
    const auto known = std::ranges::find_if(all, [&](const Told& told) {
      return told.fault.pointer == fault.pointer && told.fault.message == fault.message;
    });
    if (known == all.end()) {
      all.push_back({std::move(fault), record, 1});
    } else {
      ++known->records;
    }
  }
  refusal.faults.clear();
  for (Told& told : all) {
    if (told.records > 1) {
      told.first = fmt::format("{} of {} records, \"{}\" the first", told.records,
                               campaign.records.size(), told.first);
    }
    if (!told.first.empty()) told.fault.message.insert(0, told.first + ": ");
    refusal.faults.push_back(std::move(told.fault));
  }
  return refusal;
}

TwinOrRefusal twin_of(sim::PlantSpec plant, const Campaign& campaign,
                      const sim::TermLibrary& library) {
  const sim::ComparedBy by =
      plant.outputs.empty() ? sim::ComparedBy::samples : plant.outputs.front().compared_by;
  switch (by) {
    case sim::ComparedBy::orders: return OrderTwin::make(std::move(plant), campaign, library);
    case sim::ComparedBy::envelope: return EnvelopeTwin::make(std::move(plant), campaign, library);
    case sim::ComparedBy::samples: break;
  }
  return TimeTwin::make(std::move(plant), campaign, library);
}

}  // namespace

double Twin::Comparison::error() const {
  return std::sqrt((measured - simulated).squaredNorm() / static_cast<double>(measured.size()));
}

double Twin::Comparison::relative_error() const {
  return (measured - simulated).norm() / measured.norm();
}

TwinOrRefusal make_twin(sim::PlantSpec plant, const Campaign& campaign,
                        const sim::TermLibrary& library) {
  TwinOrRefusal made = twin_of(std::move(plant), campaign, library);
  if (auto* refusal = std::get_if<Refusal>(&made)) {
    return told_once(std::move(*refusal), campaign);
  }
  return made;
}

}  // namespace rvbench::bench
