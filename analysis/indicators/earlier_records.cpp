#include "analysis/indicators/earlier_records.hpp"

#include <algorithm>
#include <optional>

#include "hal/types/measure.hpp"

namespace rvbench::analysis {
namespace {

std::vector<double> variances_of(const std::string& gear, const ChannelExamination& channel,
                                 const std::vector<const Examination*>& earlier) {
  std::vector<double> variances;
  for (const Examination* record : earlier) {
    for (const ChannelExamination& other : record->channels) {
      if (other.name != channel.name || other.unit != channel.unit) continue;
      const auto found = std::ranges::find(other.residuals, gear, &GearResidual::of);
      if (found != other.residuals.end()) variances.push_back(found->moments.variance);
    }
  }
  return variances;
}

}  // namespace

void add_na4(Examination& record, const std::vector<const Examination*>& earlier) {
  for (ChannelExamination& channel : record.channels) {
    for (const GearResidual& residual : channel.residuals) {
      const std::vector<double> variances = variances_of(residual.of, channel, earlier);
      if (variances.empty()) continue;
      const std::optional<double> value = na4(residual.moments, variances);
      if (!value) continue;
      channel.indicators.push_back({std::string(measure_names::na4), residual.of, *value, "1"});
    }
  }
}

}  // namespace rvbench::analysis
