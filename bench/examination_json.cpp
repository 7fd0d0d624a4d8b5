#include "bench/examination_json.hpp"

#include <cmath>

#include "bench/indicators_json.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

using Json = nlohmann::ordered_json;
using analysis::ChannelExamination;
using analysis::Finding;
using analysis::Growth;
using analysis::QualityNote;
using analysis::SignatureScore;
using analysis::SpectralLine;
using analysis::UnknownFamily;

template <typename Item>
Json list_of(const std::vector<Item>& items, Json (*one)(const Item&)) {
  Json list = Json::array();
  for (const Item& item : items) list.push_back(one(item));
  return list;
}

template <typename Item>
std::vector<Item> list_from(const Json& json, Item (*one)(const Json&)) {
  std::vector<Item> items;
  for (const Json& item : json) items.push_back(one(item));
  return items;
}

std::vector<double> numbers_from(const Json& json) {
  return list_from<double>(json, number_or_nan);
}

Json json_of_note(const QualityNote& note) {
  return hal::json_object({{"where", note.where},
                           {"what", note.what},
                           {"invalidates", note.invalidates},
                           {"leaves_out", note.leaves_out}});
}

QualityNote note_from(const Json& json) {
  return {json.at("where"), json.at("what"), json.at("invalidates"),
          json.value("leaves_out", false)};
}

Json json_of_line(const SpectralLine& line) {
  return hal::json_object({{"order", line.order},
                           {"frequency_Hz", line.frequency_Hz},
                           {"amplitude", line.amplitude},
                           {"p_value", line.p_value},
                           {"meaning", line.meaning}});
}

SpectralLine line_from(const Json& json) {
  return {number_or_nan(json.at("order")), number_or_nan(json.at("frequency_Hz")),
          number_or_nan(json.at("amplitude")), number_or_nan(json.at("p_value")),
          json.at("meaning")};
}

Json json_of_growth(const Growth& growth) {
  if (!std::isfinite(growth.exponent)) return nullptr;
  return hal::json_object({{"exponent", growth.exponent}, {"error", growth.error}});
}

Growth growth_from(const Json& json) {
  if (json.is_null()) return {};
  return {number_or_nan(json.at("exponent")), number_or_nan(json.at("error"))};
}

Json json_of_finding(const Finding& finding) {
  Json json =
      hal::json_object({{"component", finding.component},
                        {"mechanism", finding.mechanism},
                        {"table4_item", nullptr},
                        {"order", finding.order},
                        {"frequency_Hz", finding.frequency_Hz},
                        {"points", finding.points},
                        {"imfs", finding.imfs},
                        {"statistic", finding.log_likelihood_ratio},
                        {"p_value", finding.p_value},
                        {"severity", finding.severity},
                        {"severity_interval", {finding.severity_low, finding.severity_high}},
                        {"confidence", finding.confidence},
                        {"advice", finding.advice},
                        {"limit", finding.limit},
                        {"of_limit", nullptr},
                        {"line_orders", finding.line_orders},
                        {"line_depths", finding.line_depths},
                        {"growth_with_load", json_of_growth(finding.growth.load)},
                        {"growth_with_speed", json_of_growth(finding.growth.speed)},
                        {"growth_fits", nullptr},
                        {"growth_p_value", nullptr},
                        {"cannot_tell_from", finding.cannot_tell_from},
                        {"may_follow_from", nullptr},
                        {"one_of", finding.one_of},
                        {"smallest_visible", finding.smallest_visible},
                        {"in_phase", finding.in_phase},
                        {"over_sound", finding.over_sound},
                        {"severity_m_s2", finding.severity_m_s2}});
  if (!finding.points.empty()) json["of_limit"] = finding.severity / finding.limit;
  if (std::isfinite(finding.growth.load.exponent)) {
    json["growth_fits"] = finding.growth_fits;
    json["growth_p_value"] = finding.growth_p_value;
  }
  if (!finding.may_follow_from.empty()) json["may_follow_from"] = finding.may_follow_from;
  if (!finding.table4_item.empty()) json["table4_item"] = finding.table4_item;
  return json;
}

Finding finding_from(const Json& json) {
  Finding finding;
  json.at("component").get_to(finding.component);
  json.at("mechanism").get_to(finding.mechanism);
  if (!json.at("table4_item").is_null()) json["table4_item"].get_to(finding.table4_item);
  finding.order = number_or_nan(json.at("order"));
  finding.frequency_Hz = number_or_nan(json.at("frequency_Hz"));
  json.at("points").get_to(finding.points);
  json.at("imfs").get_to(finding.imfs);
  finding.log_likelihood_ratio = number_or_nan(json.at("statistic"));
  finding.p_value = number_or_nan(json.at("p_value"));
  finding.severity = number_or_nan(json.at("severity"));
  // May be absent, like each key that is read with a default: then it is not known.
  const Json interval = json.value("severity_interval", Json::array({nullptr, nullptr}));
  finding.severity_low = number_or_nan(interval.at(0));
  finding.severity_high = number_or_nan(interval.at(1));
  finding.confidence = number_or_nan(json.at("confidence"));
  json.at("advice").get_to(finding.advice);
  finding.limit = number_or_nan(json.at("limit"));
  finding.line_orders = numbers_from(json.at("line_orders"));
  finding.line_depths = numbers_from(json.at("line_depths"));
  finding.growth.load = growth_from(json.value("growth_with_load", Json()));
  finding.growth.speed = growth_from(json.value("growth_with_speed", Json()));
  if (const Json fits = json.value("growth_fits", Json()); !fits.is_null()) {
    fits.get_to(finding.growth_fits);
  }
  if (const Json p = json.value("growth_p_value", Json()); !p.is_null()) {
    p.get_to(finding.growth_p_value);
  }
  finding.cannot_tell_from = json.value("cannot_tell_from", std::vector<std::string>());
  if (const Json cause = json.value("may_follow_from", Json()); !cause.is_null()) {
    cause.get_to(finding.may_follow_from);
  }
  finding.one_of = json.value("one_of", std::vector<std::string>());
  finding.smallest_visible = number_or_nan(json.value("smallest_visible", Json()));
  finding.in_phase = number_or_nan(json.value("in_phase", Json()));
  finding.over_sound = number_or_nan(json.value("over_sound", Json()));
  finding.severity_m_s2 = number_or_nan(json.value("severity_m_s2", Json()));
  return finding;
}

Json json_of_unknown(const UnknownFamily& family) {
  return hal::json_object({{"component", "unknown"},
                           {"kind", family.is_locked ? "gear-like" : "bearing-like"},
                           {"spacing", family.spacing},
                           {"harmonics", family.harmonics},
                           {"sidebands", family.sidebands},
                           {"severity", family.severity},
                           {"p_value", family.p_value},
                           {"points", family.points}});
}

UnknownFamily unknown_from(const Json& json) {
  return {.spacing = json.at("spacing"),
          .harmonics = json.at("harmonics"),
          .sidebands = json.at("sidebands"),
          .is_locked = json.at("kind") == "gear-like",
          .severity = number_or_nan(json.at("severity")),
          .p_value = number_or_nan(json.at("p_value")),
          .points = json.at("points")};
}

Json json_of_score(const SignatureScore& score) {
  return hal::json_object({{"signature", score.signature},
                           {"order", score.order},
                           {"depth", score.depth},
                           {"amplitude", score.amplitude},
                           {"by_noise", score.by_noise},
                           {"in_phase", score.in_phase},
                           {"depth2_variance", score.depth2_variance},
                           {"statistic", score.log_likelihood_ratio},
                           {"p_value", score.p_value},
                           {"imf", score.imf},
                           {"article_statistic", score.article_statistic},
                           {"channel", score.channel},
                           {"line_orders", score.line_orders},
                           {"line_depths", score.line_depths},
                           {"channel_amplitudes", score.channel_amplitudes},
                           {"smallest_visible", score.smallest_visible}});
}

SignatureScore score_from(const Json& json) {
  SignatureScore score;
  json.at("signature").get_to(score.signature);
  score.order = number_or_nan(json.at("order"));
  score.depth = number_or_nan(json.at("depth"));
  score.amplitude = number_or_nan(json.value("amplitude", Json()));
  score.by_noise = json.value("by_noise", false);
  score.in_phase = number_or_nan(json.value("in_phase", Json()));
  score.depth2_variance = number_or_nan(json.value("depth2_variance", Json()));
  score.log_likelihood_ratio = number_or_nan(json.at("statistic"));
  score.p_value = number_or_nan(json.at("p_value"));
  json.at("imf").get_to(score.imf);
  score.article_statistic = json.value("article_statistic", 0.0);
  json.at("channel").get_to(score.channel);
  score.line_orders = numbers_from(json.at("line_orders"));
  score.line_depths = numbers_from(json.at("line_depths"));
  score.channel_amplitudes = numbers_from(json.value("channel_amplitudes", Json::array()));
  score.smallest_visible = number_or_nan(json.value("smallest_visible", Json()));
  return score;
}

Json json_of_channel(const ChannelExamination& channel) {
  return hal::json_object({{"name", channel.name},
                           {"unit", channel.unit},
                           {"rms", channel.rms},
                           {"peak", channel.peak},
                           {"kurtosis", channel.kurtosis},
                           {"imf_correlation", channel.imf_correlation},
                           {"lines", list_of(channel.lines, json_of_line)},
                           {"indicators", indicators_to_json(channel.indicators)}});
}

ChannelExamination channel_from(const Json& json) {
  ChannelExamination channel;
  json.at("name").get_to(channel.name);
  json.at("unit").get_to(channel.unit);
  channel.rms = number_or_nan(json.at("rms"));
  channel.peak = number_or_nan(json.at("peak"));
  channel.kurtosis = number_or_nan(json.at("kurtosis"));
  channel.imf_correlation = numbers_from(json.at("imf_correlation"));
  channel.lines = list_from(json.at("lines"), line_from);
  channel.indicators = indicators_from_json(json);
  return channel;
}

}  // namespace

double number_or_nan(const Json& json) { return json.is_null() ? not_known : json.get<double>(); }

Json json_of(const analysis::Diagnosis& diagnosis) {
  return hal::json_object({{"findings", list_of(diagnosis.findings, json_of_finding)},
                           {"quality", list_of(diagnosis.quality, json_of_note)},
                           {"resolvable", diagnosis.resolvable},
                           {"below_limit", list_of(diagnosis.below_limit, json_of_finding)},
                           {"not_shown", list_of(diagnosis.not_shown, json_of_finding)},
                           {"unknown", list_of(diagnosis.unknown, json_of_unknown)},
                           {"unexplained", list_of(diagnosis.unexplained, json_of_line)}});
}

Json json_of(const analysis::Examination& examination) {
  return hal::json_object({{"source", examination.source},
                           {"speed_rpm", examination.speed_rpm},
                           {"angle_measured", examination.angle_measured},
                           {"load_pct", examination.load_pct},
                           {"repeat", examination.repeat},
                           {"periods", examination.periods},
                           {"resolvable", examination.resolvable},
                           {"quality", list_of(examination.quality, json_of_note)},
                           {"scores", list_of(examination.scores, json_of_score)},
                           {"unknown", list_of(examination.unknown, json_of_unknown)},
                           {"channels", list_of(examination.channels, json_of_channel)},
                           {"indicators", indicators_to_json(examination.indicators)},
                           {"of_hysteresis", examination.of_hysteresis}});
}

analysis::Diagnosis diagnosis_from_json(const Json& json) {
  return {list_from(json.at("findings"), finding_from),
          list_from(json.at("below_limit"), finding_from),
          list_from(json.value("not_shown", Json::array()), finding_from),
          list_from(json.value("unknown", Json::array()), unknown_from),
          list_from(json.at("unexplained"), line_from),
          list_from(json.at("quality"), note_from),
          json.at("resolvable")};
}

analysis::Examination examination_from_json(const Json& json) {
  analysis::Examination examination;
  json.at("source").get_to(examination.source);
  examination.speed_rpm = number_or_nan(json.at("speed_rpm"));
  examination.angle_measured = json.value("angle_measured", false);
  examination.load_pct = number_or_nan(json.at("load_pct"));
  json.at("repeat").get_to(examination.repeat);
  examination.periods = number_or_nan(json.at("periods"));
  json.at("resolvable").get_to(examination.resolvable);
  examination.quality = list_from(json.at("quality"), note_from);
  examination.scores = list_from(json.at("scores"), score_from);
  examination.unknown = list_from(json.value("unknown", Json::array()), unknown_from);
  examination.channels = list_from(json.at("channels"), channel_from);
  examination.indicators = indicators_from_json(json);
  examination.of_hysteresis = json.value("of_hysteresis", false);
  return examination;
}

}  // namespace rvbench::bench
