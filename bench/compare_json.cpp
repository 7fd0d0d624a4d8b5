#include "bench/compare_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/compare/headlines.hpp"
#include "bench/compare_text.hpp"
#include "bench/json_text.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using analysis::Change;
using analysis::Comparison;
using nlohmann::ordered_json;

const char* word(analysis::ChangeWord word) {
  switch (word) {
    case analysis::ChangeWord::changed: return "changed";
    case analysis::ChangeWord::not_changed: return "not_changed";
    case analysis::ChangeWord::cannot_tell: return "cannot_tell";
  }
  return "";
}

const char* scatter(analysis::ScatterSource source) {
  switch (source) {
    case analysis::ScatterSource::repeats: return "repeats";
    case analysis::ScatterSource::parts: return "parts_of_record";
    case analysis::ScatterSource::none: return "none";
  }
  return "";
}

ordered_json place(const analysis::PointRecords& point) {
  return hal::json_object({{"speed_rpm", finite_or_null(point.speed_rpm)},
                           {"load_pct", finite_or_null(point.load_pct)}});
}

ordered_json change_json(const Change& change, const Comparison& comparison) {
  const analysis::Quantity& quantity = comparison.quantities[change.quantity];
  ordered_json json = hal::json_object(
      {{"channel", comparison.channels[change.channel].name}, {"quantity", quantity.name}});
  if (quantity.is_line()) {
    json["order"] = quantity.order;
    json["component"] = quantity.component;
    json["seen"] = hal::json_object({{"a", change.seen_a}, {"b", change.seen_b}});
  }
  json["a"] = finite_or_null(ratio_from_dB(change.a_dB));
  json["b"] = finite_or_null(ratio_from_dB(change.b_dB));
  json["change_dB"] = finite_or_null(change.change_dB);
  json["uncertainty95_dB"] = finite_or_null(change.uncertainty_dB);
  json["ratio"] = finite_or_null(ratio_from_dB(change.change_dB));
  json["scatter"] = scatter(change.source);
  json["freedom"] = finite_or_null(change.freedom);
  json["p_value"] = finite_or_null(change.p_value);
  json["p_adjusted"] = finite_or_null(change.adjusted_p);
  json["detectable_dB"] = finite_or_null(change.detectable_dB);
  json["word"] = word(change.word);
  return json;
}

ordered_json points_json(const Comparison& comparison) {
  ordered_json points = ordered_json::array();
  for (const analysis::MatchedPoint& point : comparison.points) {
    ordered_json json = place(point.a);
    json["records"] =
        hal::json_object({{"a", point.a.records.size()}, {"b", point.b.records.size()}});
    json["changes"] = ordered_json::array();
    points.push_back(std::move(json));
  }
  for (const Change& change : comparison.changes) {
    if (!change.seen && change.word != analysis::ChangeWord::changed) continue;
    points[change.point]["changes"].push_back(change_json(change, comparison));
  }
  return points;
}

ordered_json headlines_json(const Comparison& comparison) {
  ordered_json json = ordered_json::array();
  for (const analysis::Headline& h : analysis::headlines(comparison)) {
    const analysis::Quantity& quantity = comparison.quantities[h.quantity];
    const Change& most = comparison.changes[h.strongest];
    json.push_back(hal::json_object(
        {{"quantity", quantity.name},
         {"order", finite_or_null(quantity.order)},
         {"component", quantity.component},
         {"median_dB", h.median_dB},
         {"range_dB", {h.least_dB, h.most_dB}},
         {"cells_changed", h.changed},
         {"cells_seen", h.compared},
         {"points_changed", h.points},
         {"strongest", hal::json_object({{"where", place_text(most, comparison)},
                                         {"change_dB", most.change_dB},
                                         {"uncertainty95_dB", finite_or_null(most.uncertainty_dB)},
                                         {"p_adjusted", finite_or_null(most.adjusted_p)}})}}));
  }
  return json;
}

ordered_json families_json(const Comparison& comparison, const analysis::Kinematics& kinematics) {
  ordered_json json = ordered_json::array();
  for (const analysis::FamilyHeadline& f : analysis::family_headlines(comparison)) {
    const analysis::Signature& signature = kinematics.signatures.at(f.family);
    json.push_back(hal::json_object({{"component", signature.component},
                                     {"mechanism", signature.mechanism},
                                     {"order", signature.order},
                                     {"cells", f.cells},
                                     {"cells_changed", f.changed},
                                     {"median_dB", f.median_dB},
                                     {"range_dB", {f.least_dB, f.most_dB}},
                                     {"or", ordered_json::array()}}));
    for (const std::size_t other : f.or_of) {
      json.back()["or"].push_back(
          hal::json_object({{"component", kinematics.signatures.at(other).component},
                            {"mechanism", kinematics.signatures.at(other).mechanism}}));
    }
  }
  return json;
}

ordered_json only_json(const std::vector<analysis::PointRecords>& points) {
  ordered_json json = ordered_json::array();
  for (const analysis::PointRecords& point : points) {
    ordered_json one = place(point);
    one["records"] = point.records.size();
    json.push_back(std::move(one));
  }
  return json;
}

ordered_json method_json(const analysis::CompareOptions& options) {
  return hal::json_object(
      {{"least_dB", options.least_dB},
       {"false_share", options.false_share},
       {"blind_dB", options.blind_dB},
       {"seen_p", options.seen_p},
       {"found_p", options.found_p},
       {"cell", "a level or line in a channel at a point"},
       {"test",
        "Student's t of mean levels in dB against least_dB, variance pooled over A and B and "
        "drawn towards that of cells alike (Smyth 2004)"},
       {"multiplicity",
        "Benjamini & Hochberg 1995, over all cells that are seen; over the others apart"}});
}

}  // namespace

std::string comparison_to_json(const Comparison& comparison, const CompareFacts& facts) {
  const analysis::ChangeCounts counts = analysis::counts_of(comparison);
  ordered_json json =
      hal::json_object({{"verdict", word(analysis::word_of(counts))},
                        {"sentence", compare_sentence(comparison, facts.kinematics)},
                        {"reservation", compare_reservation(comparison)},
                        {"a", facts.a},
                        {"b", facts.b},
                        {"machine", facts.kinematics.machine},
                        {"software", facts.software},
                        {"method", method_json(comparison.options)},
                        {"counts", hal::json_object({{"changed", counts.changed},
                                                     {"not_changed", counts.not_changed},
                                                     {"cannot_tell", counts.cannot_tell},
                                                     {"noise_changed", counts.noise_changed}})},
                        {"changed", headlines_json(comparison)},
                        {"families", families_json(comparison, facts.kinematics)},
                        {"only_in_a", only_json(comparison.only_a)},
                        {"only_in_b", only_json(comparison.only_b)},
                        {"left_out", ordered_json::array()},
                        {"points", points_json(comparison)},
                        {"data_sha256", ordered_json::array()}});
  for (const analysis::NotCompared& out : comparison.left_out) {
    json["left_out"].push_back(hal::json_object({{"where", out.where}, {"why", out.why}}));
  }
  for (const auto& [file, hash] : facts.hashes) {
    json["data_sha256"].push_back(hal::json_object({{"file", file}, {"sha256", hash}}));
  }
  return json_text(json, 1);
}

}  // namespace rvbench::bench
