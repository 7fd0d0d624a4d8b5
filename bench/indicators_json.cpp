#include "bench/indicators_json.hpp"

#include <cmath>

#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

constexpr const char* whole = "whole";

}  // namespace

nlohmann::ordered_json indicators_to_json(const std::vector<analysis::Indicator>& indicators) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const analysis::Indicator& indicator : indicators) {
    const bool known = !list.empty() && list.back()["name"] == indicator.measure &&
                       list.back()["unit"] == indicator.unit;
    if (!known) {
      list.push_back(hal::json_object({{"name", indicator.measure},
                                       {"unit", indicator.unit},
                                       {"values", nlohmann::ordered_json::object()}}));
    }
    const std::string of = indicator.of.empty() ? whole : indicator.of;
    list.back()["values"][of] = indicator.value;
    if (std::isfinite(indicator.error)) list.back()["errors"][of] = indicator.error;
  }
  return list;
}

std::vector<analysis::Indicator> indicators_from_json(const nlohmann::ordered_json& judged) {
  std::vector<analysis::Indicator> indicators;
  if (!judged.contains("indicators")) return indicators;
  for (const auto& measured : judged["indicators"]) {
    const auto errors = measured.value("errors", nlohmann::ordered_json::object());
    for (const auto& [of, value] : measured.at("values").items()) {
      indicators.push_back({measured.at("name"), of == whole ? "" : of, value.get<double>(),
                            measured.at("unit"), errors.value(of, not_known)});
    }
  }
  return indicators;
}

}  // namespace rvbench::bench
