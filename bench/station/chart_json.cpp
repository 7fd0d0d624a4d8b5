#include "bench/station/chart_json.hpp"

#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/software_version.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using nlohmann::ordered_json;

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json index_json(const std::optional<analysis::CapabilityIndex>& index) {
  if (!index) return nullptr;
  return hal::json_object(
      {{"value", index->value},
       {"interval", ordered_json::array({index->interval.low, index->interval.high})}});
}

ordered_json capability_json(const ChartAnswer& answer) {
  if (!answer.capability) return nullptr;
  const analysis::Capability& of = *answer.capability;
  return hal::json_object({{"lower", or_null(answer.limits.lower)},
                           {"upper", or_null(answer.limits.upper)},
                           {"cp", index_json(of.cp)},
                           {"cpk", index_json(of.cpk)},
                           {"pp", index_json(of.pp)},
                           {"ppk", index_json(of.ppk)},
                           {"normality_p", of.normality_p}});
}

ordered_json event_json(const ChartEvent& event, const ChartAnswer& answer) {
  return hal::json_object({{"at", answer.data.labels[std::size_t(event.at)]},
                           {"index", event.at},
                           {"value", answer.data.values[event.at]},
                           {"rule", event.rule},
                           {"meaning", event.meaning}});
}

}  // namespace

std::string chart_to_json(const ChartAnswer& answer) {
  const analysis::ChartBaseline& baseline = answer.chart.baseline;
  const Eigen::Index newest = answer.data.values.size() - 1;
  auto signals = ordered_json::array(), at_newest = ordered_json::array();
  for (const ChartEvent& event : events_of(answer)) {
    signals.push_back(event_json(event, answer));
    if (event.at == newest) at_newest.push_back(event.rule);
  }
  const ordered_json json = hal::json_object(
      {{"verdict", answer.is_in_control() ? "in_control" : "out_of_control"},
       {"summary", chart_sentence(answer)},
       {"file", answer.file},
       {"unit", answer.data.unit.empty() ? ordered_json(nullptr) : ordered_json(answer.data.unit)},
       {"values", answer.data.values.size()},
       {"baseline", hal::json_object({{"values", baseline.points},
                                      {"centre", baseline.centre},
                                      {"sigma", baseline.sigma},
                                      {"lower", baseline.lower()},
                                      {"upper", baseline.upper()},
                                      {"mean_range", baseline.mean_range},
                                      {"upper_range", baseline.upper_range()}})},
       {"signals", signals},
       {"newest", hal::json_object({{"at", answer.data.labels[std::size_t(newest)]},
                                    {"value", answer.data.values[newest]},
                                    {"ewma", answer.ewma.means[newest]},
                                    {"in_control", at_newest.empty()},
                                    {"rules", at_newest}})},
       {"capability", capability_json(answer)},
       {"warnings", chart_warnings(answer)},
       {"software", software_version()}});
  return json_text(json);
}

}  // namespace rvbench::bench
