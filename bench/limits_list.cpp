#include "bench/limits_list.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bench/console.hpp"
#include "bench/json_text.hpp"
#include "bench/results/run_filter.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t longest_name = 64;

}  // namespace

std::string limits_text(const std::vector<LimitsVersion>& versions) {
  std::string text;
  for (const LimitsVersion& version : versions) {
    text += fmt::format("{}  {}", version.version, version.status);
    if (version.is_in_force) text += ", in force";
    if (!version.file.version.empty()) {
      text += fmt::format(", plan {}, {} limits", version.file.plan, version.file.limits.size());
    }
    text += "\n";
    for (const LimitsStep& step : version.file.steps) {
      text += fmt::format("  {}  {} by {}\n", readable_utc(step.utc), step.step,
                          as_cell(step.by, longest_name));
    }
    if (!version.fault.empty()) text += "  ! " + version.fault + "\n";
  }
  return text;
}

nlohmann::ordered_json limits_json(const std::vector<LimitsVersion>& versions) {
  auto told = nlohmann::ordered_json::array();
  for (const LimitsVersion& version : versions) {
    nlohmann::ordered_json json = hal::json_object({{"limits_version", version.version}});
    if (!version.file.version.empty()) {
      json = parse_ordered_json(limits_file_to_json(version.file));
    }
    json["status"] = version.status;
    json["in_force"] = version.is_in_force;
    if (!version.fault.empty()) json["fault"] = version.fault;
    told.push_back(std::move(json));
  }
  return hal::json_object({{"versions", told}});
}

}  // namespace rvbench::bench
