#include "bench/explanation_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/json_text.hpp"
#include "bench/missing_force_json.hpp"

namespace rvbench::bench {
namespace {

using nlohmann::ordered_json;

ordered_json number(double value) {
  return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

ordered_json estimates(const std::vector<analysis::Estimate>& all) {
  ordered_json json = ordered_json::array();
  for (const analysis::Estimate& e : all) {
    json.push_back({{"name", e.name},
                    {"value", number(e.value)},
                    {"unit", e.unit},
                    {"ci90", {number(e.low), number(e.high)}}});
  }
  return json;
}

ordered_json rivals(const std::vector<analysis::RivalEffect>& all) {
  ordered_json json = ordered_json::array();
  for (const analysis::RivalEffect& rival : all) {
    json.push_back({{"name", rival.name},
                    {"where", rival.where},
                    {"delta", number(rival.behind.delta)},
                    {"se", number(rival.behind.se)}});
  }
  return json;
}

// Null if no records repeat each other.
ordered_json self_null(const analysis::SelfNull& found) {
  if (!found.known) return nullptr;
  return {{"verdict", found.found.empty() ? "NULL" : "NAMED"},
          {"error", number(found.error)},
          {"found", estimates(found.found)}};
}

// Null of a record that was learned from.
ordered_json mean_json(const std::optional<PredictedMean>& mean) {
  if (!mean) return nullptr;
  return {
      {"measured", number(mean->measured)},
      {"predicted", number(mean->predicted)},
      {"ci90",
       {number(mean->predicted - mean->half_width), number(mean->predicted + mean->half_width)}}};
}

ordered_json record_errors_json(const std::vector<RecordError>& records) {
  ordered_json json = ordered_json::array();
  for (const RecordError& record : records) {
    json.push_back({{"record", record.record},
                    {"channel", record.channel},
                    {"unit", record.unit},
                    {"use", record.learned_from ? "learn" : "predict"},
                    {"rms_before", number(record.before)},
                    {"rms_after", number(record.after)},
                    {"relative_before", number(record.relative_before)},
                    {"relative_after", number(record.relative_after)},
                    {"mean", mean_json(record.mean)}});
  }
  return json;
}

ordered_json clusters_json(const std::vector<analysis::ResidualCluster>& clusters) {
  ordered_json json = ordered_json::array();
  for (const analysis::ResidualCluster& c : clusters) {
    json.push_back({{"channel", c.channel},
                    {"locked_to", to_string(c.locked_to)},
                    {"first", number(c.first)},
                    {"last", number(c.last)},
                    {"conditions", c.conditions},
                    {"apart", number(c.apart)},
                    {"unit", c.unit},
                    {"standard_errors", number(c.standard_errors)}});
  }
  return json;
}

// Null if the comparison knows no means and lines.
ordered_json located_json(const Located& located) {
  if (located.cells == 0) return nullptr;
  ordered_json noise = ordered_json::array();
  for (const Twin::Noise& n : located.noise) {
    noise.push_back({{"channel", n.channel},
                     {"of", n.of},
                     {"standard_deviation", number(n.standard_deviation)},
                     {"unit", n.unit}});
  }
  return {{"cells", located.cells},
          {"noise", noise},
          {"before", clusters_json(located.before)},
          {"after", clusters_json(located.after)},
          {"missing_force",
           {{"before", missing_force_to_json(located.missing_before)},
            {"after", missing_force_to_json(located.missing_after)}}}};
}

ordered_json left_out_json(const analysis::LeftOutError& error) {
  if (!error.known) return nullptr;
  return {{"before", number(error.before)},
          {"after", number(error.after)},
          {"floor", error.floor ? number(*error.floor) : ordered_json(nullptr)}};
}

ordered_json effect_json(const analysis::ExplainedEffect& effect, const ordered_json& floor,
                         const char* metric) {
  return {{"verdict", to_string(effect.verdict)},
          {"name", effect.name},
          {"class", effect.one_of},
          {"location", {{"where", effect.where}}},
          {"parameters", estimates(effect.parameters)},
          {"held_out",
           {{"before", number(effect.error_before)},
            {"after", number(effect.error_after)},
            {"floor", floor},
            {"metric", metric}}},
          {"p_value", number(effect.p_value)},
          {"bootstraps_won", number(effect.share_won)},
          {"rivals", rivals(effect.rivals)},
          {"next_experiment", effect.next_experiment}};
}

}  // namespace

std::string explanation_to_json(const analysis::Explanation& e, const ExplainFacts& facts) {
  const std::optional<double> least = noise_floor(e);
  const ordered_json floor = least ? number(*least) : ordered_json(nullptr);
  const char* const metric = e.in_standard_errors ? "RMS of standard errors on left-out conditions"
                                                  : "relative RMS error on left-out conditions";
  ordered_json effects = ordered_json::array();
  for (const analysis::ExplainedEffect& effect : e.effects) {
    effects.push_back(effect_json(effect, floor, metric));
  }
  ordered_json hashes = ordered_json::array();
  for (const auto& [file, hash] : facts.hashes) {
    hashes.push_back({{"file", file}, {"sha256", hash}});
  }
  const ordered_json json{
      {"verdict", to_string(e.verdict)},
      {"reason", e.reason},
      {"effects", effects},
      {"base", estimates(e.base)},
      {"nuisances", estimates(e.nuisances)},
      {"fit",
       {{"train", {{"before", number(e.trained_before)}, {"after", number(e.trained_after)}}},
        {"held_out",
         {{"before", number(e.held_out_before)},
          {"after", number(e.held_out_after)},
          {"floor", floor},
          {"speeds", left_out_json(e.speeds_out)},
          {"loads", left_out_json(e.loads_out)}}}}},
      {"located", located_json(facts.located)},
      {"records", record_errors_json(facts.records)},
      {"self_null", self_null(e.self_null)},
      {"cannot_exclude", rivals(e.cannot_exclude)},
      {"plant", facts.plant},
      {"plant_updated",
       facts.plant_updated.empty() ? ordered_json(nullptr) : ordered_json(facts.plant_updated)},
      {"notes", facts.notes},
      {"software", facts.software},
      {"data_sha256", hashes}};
  return json_text(json);
}

}  // namespace rvbench::bench
