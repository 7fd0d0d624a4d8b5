#include "bench/missing_force_json.hpp"

#include <nlohmann/json.hpp>

#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using nlohmann::ordered_json;

ordered_json line_json(const MissingForce& missing, const analysis::LinePushes& line) {
  ordered_json sites = ordered_json::array();
  for (const analysis::SitePush& push : line.sites) {
    const ForceSite& site = missing.sites[push.site];
    sites.push_back({{site.is_joint ? "joint" : "body", site.name},
                     {"share", push.share},
                     {"se", push.standard_error},
                     {"p_value", push.p_value},
                     {"size", push.size},
                     {"unit", site.unit},
                     {"size_on", site.on},
                     {"as_good_as_best", push.is_as_good}});
  }
  return hal::json_object(
      {{"locked_to", to_string(line.locked_to)}, {"place", line.place}, {"sites", sites}});
}

ordered_json source_json(const MissingForce& missing, const analysis::PushSource& source) {
  ordered_json lines = ordered_json::array(), sites = ordered_json::array();
  for (const std::size_t line : source.lines) lines.push_back(missing.pushes.lines[line].place);
  for (const std::size_t site : source.sites) sites.push_back(missing.sites[site].name);
  return hal::json_object(
      {{"says", source_text(missing, source)}, {"lines", lines}, {"sites", sites}});
}

ordered_json balance_json(const MissingForce& missing, const analysis::SideBalance& balance) {
  const bool is_left = balance.side == analysis::Side::left;
  return hal::json_object(
      {{"says", balance_text(missing, balance)},
       {"transducer", missing.transducer},
       {"side", to_string(balance.side)},
       {"bodies", is_left ? missing.left : missing.right},
       {"of", is_left ? "drive" : "drag"},
       {"mean", balance.mean_Nm},
       {"se", balance.standard_error_Nm},
       {"unit", "N·m"},
       {"range", {balance.least_Nm, balance.most_Nm}},
       {"per_load",
        hal::json_object({{"value", balance.per_load}, {"se", balance.per_load_error}})},
       {"per_rad_s",
        hal::json_object({{"value", balance.per_speed}, {"se", balance.per_speed_error}})},
       {"law", law_text(balance)}});
}

}  // namespace

ordered_json missing_force_to_json(const MissingForce& missing) {
  ordered_json sources = ordered_json::array(), lines = sources, balances = sources;
  for (const analysis::PushSource& source : missing.pushes.sources) {
    sources.push_back(source_json(missing, source));
  }
  for (const analysis::LinePushes& line : missing.pushes.lines) {
    lines.push_back(line_json(missing, line));
  }
  for (const analysis::SideBalance& balance : missing.balances) {
    balances.push_back(balance_json(missing, balance));
  }
  return hal::json_object({{"sources", sources}, {"lines", lines}, {"balances", balances}});
}

}  // namespace rvbench::bench
