#include "bench/qualification/qualification_section.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <utility>

#include "analysis/station/control_chart.hpp"
#include "bench/json_text.hpp"
#include "bench/lower_case.hpp"
#include "bench/results/run_filter.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/formats/printable.hpp"
#include "hal/json_object.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

constexpr double longest_age_h = 87600;  // ten years

// A number of the self-test: its key, where it is kept, and what it may be.
struct SpecNumber {
  const char* key;
  double SelfTestSpec::*value;
  hal::Bounds bounds;
};

constexpr SpecNumber spec_numbers[] = {
    {"max_age_h", &SelfTestSpec::max_age_h, {0.1, longest_age_h}},
    {"rest_s", &SelfTestSpec::rest_s, {0.5, 60}},
    {"noise_m_s2", &SelfTestSpec::noise_m_s2, {1e-6, 1e4}},
    {"noise_Nm", &SelfTestSpec::noise_Nm, {1e-6, 1e4}},
    {"bias_m_s2", &SelfTestSpec::bias_m_s2, {1e-6, 1e4}},
    {"bias_Nm", &SelfTestSpec::bias_Nm, {1e-6, 1e4}},
    {"tap_m_s2", &SelfTestSpec::tap_m_s2, {1e-3, 1e4}},
    {"tap_timeout_s", &SelfTestSpec::tap_timeout_s, {1, 600}},
    {"speed_rpm", &SelfTestSpec::speed_rpm, {10, 3000}},
    {"speed_tolerance_pct", &SelfTestSpec::speed_tolerance_pct, {0.1, 50}},
    {"brake_torque_Nm", &SelfTestSpec::brake_torque_Nm, {0.1, 1e5}},
    {"brake_tolerance_pct", &SelfTestSpec::brake_tolerance_pct, {0.1, 100}},
    {"gear_ratio", &SelfTestSpec::gear_ratio, {1, 1e4}},
    {"torque_tolerance_pct", &SelfTestSpec::torque_tolerance_pct, {1, 100}},
    {"most_input_torque_Nm", &SelfTestSpec::most_input_torque_Nm, {0.1, 1e4}},
    {"most_acceleration_m_s2", &SelfTestSpec::most_acceleration_m_s2, {1, 1e4}},
    {"most_housing_temp_degC", &SelfTestSpec::most_housing_temp_degC, {30, 150}}};

SelfTestSpec read_self_test(hal::ConfigReader& section) {
  SelfTestSpec spec;
  spec.tap = section.boolean("tap", spec.tap);
  for (const auto& [key, value, bounds] : spec_numbers) {
    spec.*value = section.number(key, bounds, spec.*value);
  }
  return spec;
}

CalibrationDemand read_calibration(hal::ConfigReader& section,
                                   const std::vector<ChannelInfo>& channels) {
  CalibrationDemand demand;
  demand.channels = section.texts("channels");
  demand.warn_days = section.number("warn_days", {0, 365}, demand.warn_days);
  std::vector<std::string> known;
  for (const ChannelInfo& channel : channels) known.push_back(channel.name);
  std::set<std::string> seen;
  for (const std::string& channel : demand.channels) {
    if (std::ranges::find(known, channel) == known.end()) {
      section.fault("channels", "the rig has no channel " + hal::in_quotes(channel) +
                                    hal::what_there_is(channel, known));
    } else if (!seen.insert(channel).second) {
      section.fault("channels", hal::in_quotes(channel) + " is there twice");
    }
  }
  return demand;
}

// Whatever their case, and without blanks.
std::string letters_of(std::string serial) {
  std::erase(serial, ' ');
  return lower_case(std::move(serial));
}

ChartedIndicator read_indicator(hal::ConfigReader& json) {
  ChartedIndicator indicator{json.text("measure"), json.text("of", "")};
  if (json.is_text("measure") && find_measure(indicator.measure) == nullptr) {
    std::vector<std::string> names;
    for (const Measure& measure : measures()) names.emplace_back(measure.name);
    json.fault("measure", hal::in_quotes(indicator.measure) + " is not measured" +
                              hal::did_you_mean(indicator.measure, names));
  }
  return indicator;
}

GoldenUnitDemand read_golden_unit(hal::ConfigReader& section) {
  GoldenUnitDemand demand;
  demand.serial = section.text("serial");
  if (demand.serial.starts_with(' ') || demand.serial.ends_with(' ') ||
      hal::formats::has_control_character(demand.serial)) {
    section.fault("serial",
                  "no run can have it: no blank may begin or end it, and no control "
                  "character be in it");
  }
  demand.plan = section.text("plan");
  demand.max_age_h = section.number("max_age_h", {0.1, longest_age_h}, demand.max_age_h);
  demand.baseline_runs = section.integer("baseline_runs", {double(analysis::least_baseline), 1000},
                                         demand.baseline_runs);
  if (const std::string since = section.text("since", ""); !since.empty()) {
    const auto utc = utc_of_text(since, false);
    if (!utc) section.fault("since", hal::in_quotes(since) + " is no time as 2026-11-02 14:00");
    demand.since_utc = utc.value_or("");
  }
  std::vector<ChartedIndicator> indicators;
  for (hal::ConfigReader& json : section.objects("indicators", false)) {
    indicators.push_back(read_indicator(json));
  }
  if (section.has("indicators") && indicators.empty()) section.fault("indicators", "it is empty");
  if (!indicators.empty()) demand.indicators = std::move(indicators);
  for (hal::ConfigReader& json : section.objects("points", false)) {
    demand.points.push_back(
        {json.number("speed_rpm", {0.1, 10000}), json.number("load_pct", {0, 300})});
  }
  return demand;
}

nlohmann::ordered_json to_json(const SelfTestSpec& spec) {
  nlohmann::ordered_json json = hal::json_object({{"tap", spec.tap}});
  for (const auto& [key, value, bounds] : spec_numbers) json[key] = spec.*value;
  return json;
}

nlohmann::ordered_json to_json(const GoldenUnitDemand& demand) {
  auto indicators = nlohmann::ordered_json::array();
  for (const ChartedIndicator& indicator : demand.indicators) {
    indicators.push_back(hal::json_object({{"measure", indicator.measure}, {"of", indicator.of}}));
  }
  auto points = nlohmann::ordered_json::array();
  for (const SetPoint& point : demand.points) {
    points.push_back(
        hal::json_object({{"speed_rpm", *point.speed_rpm}, {"load_pct", *point.load_pct}}));
  }
  nlohmann::ordered_json json = hal::json_object({{"serial", demand.serial},
                                                  {"plan", demand.plan},
                                                  {"max_age_h", demand.max_age_h},
                                                  {"baseline_runs", demand.baseline_runs}});
  if (!demand.since_utc.empty()) json["since"] = demand.since_utc;
  json["indicators"] = indicators;
  json["points"] = points;
  return json;
}

}  // namespace

std::optional<QualificationSection> read_qualification_section(
    hal::ConfigReader& rig, const std::string& rig_kind, const std::vector<ChannelInfo>& channels) {
  auto section = rig.optional_object("qualification");
  if (!section) return std::nullopt;
  QualificationSection asked;
  asked.rig_kind = rig_kind;
  asked.station = section->text("station");
  if (auto json = section->optional_object("self_test")) asked.self_test = read_self_test(*json);
  if (auto json = section->optional_object("calibration")) {
    asked.calibration = read_calibration(*json, channels);
  }
  if (auto json = section->optional_object("golden_unit")) {
    asked.golden_unit = read_golden_unit(*json);
  }
  if (!asked.self_test && !asked.calibration && !asked.golden_unit) {
    section->fault("", "asks for nothing: give self_test, calibration or golden_unit");
  }
  return asked;
}

bool is_almost_golden(const QualificationSection* section, const std::string& serial) {
  if (section == nullptr || !section->golden_unit) return false;
  const std::string& golden = section->golden_unit->serial;
  return serial != golden && letters_of(serial) == letters_of(golden);
}

std::string limits_of(const SelfTestSpec& spec) {
  nlohmann::ordered_json json = to_json(spec);
  json.erase("max_age_h");
  return json_line(json);
}

nlohmann::ordered_json to_json(const QualificationSection& section) {
  nlohmann::ordered_json json = hal::json_object({{"station", section.station}});
  if (section.self_test) json["self_test"] = to_json(*section.self_test);
  if (section.calibration) {
    json["calibration"] = hal::json_object({{"channels", section.calibration->channels},
                                            {"warn_days", section.calibration->warn_days}});
  }
  if (section.golden_unit) json["golden_unit"] = to_json(*section.golden_unit);
  return json;
}

}  // namespace rvbench::bench
