#include "bench/explanation_json.hpp"

#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/missing_force_json.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using nlohmann::ordered_json;

ordered_json estimates(const std::vector<analysis::Estimate>& all) {
  ordered_json json = ordered_json::array();
  for (const analysis::Estimate& e : all) {
    json.push_back(hal::json_object({{"name", e.name},
                                     {"value", finite_or_null(e.value)},
                                     {"unit", e.unit},
                                     {"ci90", {finite_or_null(e.low), finite_or_null(e.high)}}}));
  }
  return json;
}

ordered_json rivals(const std::vector<analysis::RivalEffect>& all) {
  ordered_json json = ordered_json::array();
  for (const analysis::RivalEffect& rival : all) {
    json.push_back(hal::json_object({{"name", rival.name},
                                     {"where", rival.where},
                                     {"delta", finite_or_null(rival.behind.delta)},
                                     {"se", finite_or_null(rival.behind.se)}}));
  }
  return json;
}

// Null if no records repeat each other.
ordered_json self_null(const analysis::SelfNull& found) {
  if (!found.known) return nullptr;
  return hal::json_object({{"verdict", found.found.empty() ? "NULL" : "NAMED"},
                           {"error", finite_or_null(found.error)},
                           {"found", estimates(found.found)}});
}

// Null of a record that was learned from.
ordered_json mean_json(const std::optional<PredictedMean>& mean) {
  if (!mean) return nullptr;
  return hal::json_object({{"measured", finite_or_null(mean->measured)},
                           {"predicted", finite_or_null(mean->predicted)},
                           {"ci90",
                            {finite_or_null(mean->predicted - mean->half_width),
                             finite_or_null(mean->predicted + mean->half_width)}}});
}

ordered_json record_errors_json(const std::vector<RecordError>& records) {
  ordered_json json = ordered_json::array();
  for (const RecordError& record : records) {
    json.push_back(hal::json_object({{"record", record.record},
                                     {"channel", record.channel},
                                     {"unit", record.unit},
                                     {"use", record.learned_from ? "learn" : "predict"},
                                     {"rms_before", finite_or_null(record.before)},
                                     {"rms_after", finite_or_null(record.after)},
                                     {"relative_before", finite_or_null(record.relative_before)},
                                     {"relative_after", finite_or_null(record.relative_after)},
                                     {"mean", mean_json(record.mean)}}));
  }
  return json;
}

ordered_json clusters_json(const std::vector<analysis::ResidualCluster>& clusters) {
  ordered_json json = ordered_json::array();
  for (const analysis::ResidualCluster& c : clusters) {
    json.push_back(hal::json_object({{"channel", c.channel},
                                     {"locked_to", to_string(c.locked_to)},
                                     {"first", finite_or_null(c.first)},
                                     {"last", finite_or_null(c.last)},
                                     {"conditions", c.conditions},
                                     {"apart", finite_or_null(c.apart)},
                                     {"unit", c.unit},
                                     {"standard_errors", finite_or_null(c.standard_errors)}}));
  }
  return json;
}

// Null if the comparison knows no means and lines.
ordered_json located_json(const Located& located) {
  if (located.cells == 0) return nullptr;
  ordered_json noise = ordered_json::array();
  for (const Twin::Noise& n : located.noise) {
    noise.push_back(hal::json_object({{"channel", n.channel},
                                      {"of", n.of},
                                      {"standard_deviation", finite_or_null(n.standard_deviation)},
                                      {"unit", n.unit}}));
  }
  return hal::json_object(
      {{"cells", located.cells},
       {"noise", noise},
       {"before", clusters_json(located.before)},
       {"after", clusters_json(located.after)},
       {"missing_force",
        hal::json_object({{"before", missing_force_to_json(located.missing_before)},
                          {"after", missing_force_to_json(located.missing_after)}})}});
}

ordered_json left_out_json(const analysis::LeftOutError& error) {
  if (!error.known) return nullptr;
  return hal::json_object(
      {{"before", finite_or_null(error.before)},
       {"after", finite_or_null(error.after)},
       {"floor", error.floor ? finite_or_null(*error.floor) : ordered_json(nullptr)}});
}

ordered_json effect_json(const analysis::ExplainedEffect& effect, const ordered_json& floor,
                         const char* metric) {
  return hal::json_object(
      {{"verdict", to_string(effect.verdict)},
       {"name", effect.name},
       {"class", effect.one_of},
       {"location", hal::json_object({{"where", effect.where}})},
       {"parameters", estimates(effect.parameters)},
       {"held_out", hal::json_object({{"before", finite_or_null(effect.error_before)},
                                      {"after", finite_or_null(effect.error_after)},
                                      {"floor", floor},
                                      {"metric", metric}})},
       {"p_value", finite_or_null(effect.p_value)},
       {"bootstraps_won", finite_or_null(effect.share_won)},
       {"rivals", rivals(effect.rivals)},
       {"next_experiment", effect.next_experiment}});
}

}  // namespace

std::string explanation_to_json(const analysis::Explanation& e, const ExplainFacts& facts) {
  const std::optional<double> least = noise_floor(e);
  const ordered_json floor = least ? finite_or_null(*least) : ordered_json(nullptr);
  const char* const metric = e.in_standard_errors ? "RMS of standard errors on left-out conditions"
                                                  : "relative RMS error on left-out conditions";
  ordered_json effects = ordered_json::array();
  for (const analysis::ExplainedEffect& effect : e.effects) {
    effects.push_back(effect_json(effect, floor, metric));
  }
  ordered_json hashes = ordered_json::array();
  for (const auto& [file, hash] : facts.hashes) {
    hashes.push_back(hal::json_object({{"file", file}, {"sha256", hash}}));
  }
  const ordered_json json = hal::json_object(
      {{"verdict", to_string(e.verdict)},
       {"reason", e.reason},
       {"effects", effects},
       {"base", estimates(e.base)},
       {"nuisances", estimates(e.nuisances)},
       {"fit", hal::json_object(
                   {{"train", hal::json_object({{"before", finite_or_null(e.trained_before)},
                                                {"after", finite_or_null(e.trained_after)}})},
                    {"held_out", hal::json_object({{"before", finite_or_null(e.held_out_before)},
                                                   {"after", finite_or_null(e.held_out_after)},
                                                   {"floor", floor},
                                                   {"speeds", left_out_json(e.speeds_out)},
                                                   {"loads", left_out_json(e.loads_out)}})}})},
       {"located", located_json(facts.located)},
       {"records", record_errors_json(facts.records)},
       {"self_null", self_null(e.self_null)},
       {"cannot_exclude", rivals(e.cannot_exclude)},
       {"plant", facts.plant},
       {"plant_updated",
        facts.plant_updated.empty() ? ordered_json(nullptr) : ordered_json(facts.plant_updated)},
       {"notes", facts.notes},
       {"software", facts.software},
       {"data_sha256", hashes}});
  return json_text(json);
}

}  // namespace rvbench::bench
