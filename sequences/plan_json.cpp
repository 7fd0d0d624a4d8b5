#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "hal/did_you_mean.hpp"
#include "hal/json_object.hpp"
#include "hal/types/measure.hpp"
#include "sequences/limits_json.hpp"
#include "sequences/limits_on_plan.hpp"
#include "sequences/phase_registry.hpp"
#include "sequences/plan.hpp"
#include "sequences/timeline.hpp"

namespace rvbench::sequences {
namespace {

Specimen parse_specimen(hal::ConfigReader json) {
  Specimen specimen;
  specimen.kinematics = json.text("kinematics");
  specimen.gear_ratio = json.number("gear_ratio", {1.01, 10000});
  specimen.rated_output_torque_Nm = json.number("rated_output_torque_Nm", {0.1, 100000});
  return specimen;
}

Interlocks parse_interlocks(hal::ConfigReader& json) {
  Interlocks limits;  // without fallbacks: whoever writes a plan decides what is safe
  limits.input_speed_rpm = json.number("input_speed_rpm", {1, 20000});
  limits.input_torque_Nm = json.number("input_torque_Nm", {0.01, 10000});
  limits.acceleration_m_s2 = json.number("acceleration_m_s2", {0.1, 100000});
  limits.housing_temp_degC = json.number("housing_temp_degC", {0, 200});
  limits.stale_after_s = json.number("stale_after_s", {0.15, 2});
  return limits;
}

std::vector<std::unique_ptr<Phase>> parse_phases(hal::ConfigReader& root, const char* stage) {
  std::vector<std::unique_ptr<Phase>> phases;
  for (hal::ConfigReader& json : root.objects(stage)) {
    auto phase = parse_phase(json);
    if (!phase) continue;
    const bool first_of_all = std::string_view(stage) == "setup" && phases.empty();
    if ((phase->kind() == "connect") != first_of_all) {
      json.fault("phase", "\"connect\" comes once, as the first phase of setup");
    }
    if (!phase->points().empty() && std::string_view(stage) == "setup") {
      json.fault("phase", "nothing is recorded in setup: this belongs into main");
    }
    phases.push_back(std::move(phase));
  }
  if (phases.empty() && root.faults().empty()) root.fault(stage, "must not be empty");
  return phases;
}

Teardown parse_teardown(hal::ConfigReader& root) {
  Teardown teardown;
  if (auto json = root.optional_object("teardown")) {
    teardown.standstill_timeout_s =
        json->number("standstill_timeout_s", {5, 600}, teardown.standstill_timeout_s);
    teardown.standstill_rpm = json->number("standstill_rpm", {0.1, 100}, teardown.standstill_rpm);
  }
  return teardown;
}

std::string parse_unit(const Measure& measure, hal::ConfigReader& json) {
  if (measure.units.front() != "1") return json.choice("unit", measure.units);
  const std::string unit = json.text("unit", "1");
  if (unit != "1" && !unit.empty()) {
    json.fault("unit", fmt::format("{} is a pure number: its unit is \"1\", not {}", measure.name,
                                   hal::in_quotes(unit)));
  }
  return "1";
}

// A value is bounded from one side: two sides are two limits, each with a reason of its own.
void parse_bound(const Measure& measure, Limit& limit, hal::ConfigReader& json) {
  const hal::Bounds possible{measure.least, measure.most};
  if (!json.has("min")) {
    limit.max = json.number("max", possible);
    return;
  }
  limit.min = json.number("min", possible);
  limit.max = not_known;
  if (json.has("max")) json.fault("max", "beside \"min\": make it a limit of its own");
}

SetPoint parse_set_point(hal::ConfigReader& json) {
  SetPoint at;
  if (json.has("speed_rpm")) at.speed_rpm = json.number("speed_rpm", {0, 10000});
  if (json.has("load_pct")) at.load_pct = json.number("load_pct", {0, 300});
  return at;
}

Limit parse_limit(const Measure& measure, hal::ConfigReader& json) {
  Limit limit;
  limit.measure = measure.name;
  limit.component = json.text("component", "");
  limit.of = json.text("of", "");
  limit.unit = parse_unit(measure, json);
  parse_bound(measure, limit, json);
  limit.at = parse_set_point(json);
  limit.why = json.text("why");
  const bool is_depth = limit.measure == measure_names::modulation_depth;
  if (is_depth && !limit.of.empty()) json.fault("of", "a depth is narrowed by \"component\"");
  if (is_depth && std::isfinite(limit.min)) json.fault("min", "no depth is too small");
  if (is_depth && !limit.at.is_any()) {
    json.fault(limit.at.speed_rpm ? "speed_rpm" : "load_pct",
               "a depth is concluded from all points together: leave it out");
  }
  if (!is_depth && !limit.component.empty()) {
    json.fault("component", fmt::format("only modulation_depth is of a part, {} is narrowed by "
                                        "\"of\"",
                                        limit.measure));
  }
  return limit;
}

// Whether no value keeps to both: one asks for more than the other allows.
bool contradict(const Limit& a, const Limit& b) {
  if (a.measure != b.measure) return false;
  if (!a.of.empty() && !b.of.empty() && a.of != b.of) return false;
  if (!overlap(a.at, b.at)) return false;
  return in_unit(a.min, a.unit, b.unit) > b.max || in_unit(b.min, b.unit, a.unit) > a.max;
}

// Whether both bound the same thing from the same side: then one of them says nothing.
bool repeats(const Limit& a, const Limit& b) {
  return a.measure == b.measure && a.of == b.of && a.component == b.component && a.at == b.at &&
         std::isfinite(a.min) == std::isfinite(b.min);
}

void check_against_earlier(const Limit& limit, const std::vector<Limit>& earlier,
                           hal::ConfigReader& json) {
  const auto same =
      std::ranges::find_if(earlier, [&](const Limit& e) { return repeats(limit, e); });
  if (same != earlier.end()) {
    const bool both_min = std::isfinite(limit.min);
    json.fault(both_min ? "min" : "max",
               fmt::format("{}{} has a {} already, {:g} {}: one of the two says nothing",
                           limit.measure, at_text(limit.at), both_min ? "min" : "max",
                           both_min ? same->min : same->max, hal::in_quotes(same->why)));
    return;
  }
  const auto other =
      std::ranges::find_if(earlier, [&](const Limit& e) { return contradict(limit, e); });
  if (other == earlier.end()) return;
  const bool from_below = std::isfinite(limit.min);
  json.fault(from_below ? "min" : "max",
             fmt::format("no {} keeps to it and to the {} {:g} that {} asks for", limit.measure,
                         from_below ? "max" : "min", from_below ? other->max : other->min,
                         hal::in_quotes(other->why)));
}

void check_against_points(const TestPlan& plan, hal::ConfigReader& root) {
  std::size_t i = 0;
  for (hal::ConfigReader& json : root.objects("limits", false)) {
    if (const auto mismatch = mismatch_of(plan.limits[i++], plan)) {
      json.fault(mismatch->key, mismatch->why);
    }
  }
}

// An interlock that the plan itself must run into is a fault of the plan.
void check_against_interlocks(const TestPlan& plan, hal::ConfigReader& interlocks) {
  double fastest_rpm = 0;
  double largest_Nm = 0;
  for (const Segment& segment : timeline(plan)) {
    fastest_rpm = std::max(fastest_rpm, segment.speed_rpm);
    largest_Nm = std::max(largest_Nm, segment.output_torque_Nm / plan.specimen.gear_ratio);
  }
  if (fastest_rpm >= plan.interlocks.input_speed_rpm) {
    interlocks.fault("input_speed_rpm",
                     fmt::format("{:g} is not above the plan's fastest speed, {:g} rpm",
                                 plan.interlocks.input_speed_rpm, fastest_rpm));
  }
  if (largest_Nm >= plan.interlocks.input_torque_Nm) {
    interlocks.fault("input_torque_Nm",
                     fmt::format("{:g} is not above what the plan's largest load takes, {:.3g} N·m",
                                 plan.interlocks.input_torque_Nm, largest_Nm));
  }
}

nlohmann::ordered_json phases_json(const std::vector<std::unique_ptr<Phase>>& phases) {
  auto json = nlohmann::ordered_json::array();
  for (const auto& phase : phases) json.push_back(nlohmann::ordered_json::parse(phase->to_json()));
  return json;
}

nlohmann::ordered_json limits_json(const std::vector<Limit>& limits) {
  auto json = nlohmann::ordered_json::array();
  for (const Limit& limit : limits) {
    const bool from_below = std::isfinite(limit.min);
    nlohmann::ordered_json item =
        hal::json_object({{"measure", limit.measure}, {"component", limit.component}});
    if (!limit.of.empty()) item["of"] = limit.of;
    item["unit"] = limit.unit;
    if (limit.at.speed_rpm) item["speed_rpm"] = *limit.at.speed_rpm;
    if (limit.at.load_pct) item["load_pct"] = *limit.at.load_pct;
    item[from_below ? "min" : "max"] = from_below ? limit.min : limit.max;
    item["why"] = limit.why;
    json.push_back(std::move(item));
  }
  return json;
}

}  // namespace

std::vector<Limit> parse_limits(hal::ConfigReader& root) {
  std::vector<std::string> names;
  for (const Measure& measure : measures()) names.emplace_back(measure.name);
  std::vector<Limit> limits;
  for (hal::ConfigReader& json : root.objects("limits", false)) {
    const std::string name = json.text("measure");
    if (const Measure* measure = find_measure(name)) {
      Limit limit = parse_limit(*measure, json);
      if (root.faults().empty()) check_against_earlier(limit, limits, json);
      limits.push_back(std::move(limit));
      continue;
    }
    if (!name.empty()) {
      json.fault("measure",
                 hal::in_quotes(name) + " is not measured" + hal::what_there_is(name, names));
    }
    json.disregard();
  }
  return limits;
}

std::string limits_to_json(const std::vector<Limit>& limits) { return limits_json(limits).dump(); }

std::vector<hal::PlannedPoint> TestPlan::points() const {
  std::vector<hal::PlannedPoint> all;
  for (const auto& phase : main) {
    const auto points = phase->points();
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

std::variant<TestPlan, std::vector<hal::ConfigFault>> read_plan(const std::filesystem::path& file) {
  return parse_plan(hal::ConfigReader::from_file(file));
}

std::variant<TestPlan, std::vector<hal::ConfigFault>> parse_plan(hal::ConfigReader root) {
  TestPlan plan;
  plan.name = root.text("name");
  plan.description = root.text("description", "");
  plan.specimen = parse_specimen(root.object("specimen"));
  plan.acceleration_rate_Hz =
      root.number("acceleration_rate_Hz", {100, 102400}, plan.acceleration_rate_Hz);
  plan.channels_may_fail = root.integer("channels_may_fail", {0, 100}, plan.channels_may_fail);
  hal::ConfigReader interlocks = root.object("interlocks");
  plan.interlocks = parse_interlocks(interlocks);
  plan.setup = parse_phases(root, "setup");
  plan.main = parse_phases(root, "main");
  plan.teardown = parse_teardown(root);
  plan.limits = parse_limits(root);
  root.finish();
  if (root.faults().empty() && plan.points().empty()) root.fault("main", "it records nothing");
  if (root.faults().empty()) {
    check_against_interlocks(plan, interlocks);
    check_against_points(plan, root);
  }
  if (!root.faults().empty()) return root.faults();
  return plan;
}

std::string plan_to_json(const TestPlan& plan) {
  const Interlocks& limits = plan.interlocks;
  const nlohmann::ordered_json json = hal::json_object(
      {{"name", plan.name},
       {"description", plan.description},
       {"specimen",
        hal::json_object({{"kinematics", plan.specimen.kinematics},
                          {"gear_ratio", plan.specimen.gear_ratio},
                          {"rated_output_torque_Nm", plan.specimen.rated_output_torque_Nm}})},
       {"acceleration_rate_Hz", plan.acceleration_rate_Hz},
       {"channels_may_fail", plan.channels_may_fail},
       {"interlocks", hal::json_object({{"input_speed_rpm", limits.input_speed_rpm},
                                        {"input_torque_Nm", limits.input_torque_Nm},
                                        {"acceleration_m_s2", limits.acceleration_m_s2},
                                        {"housing_temp_degC", limits.housing_temp_degC},
                                        {"stale_after_s", limits.stale_after_s}})},
       {"setup", phases_json(plan.setup)},
       {"main", phases_json(plan.main)},
       {"teardown", hal::json_object({{"standstill_timeout_s", plan.teardown.standstill_timeout_s},
                                      {"standstill_rpm", plan.teardown.standstill_rpm}})},
       {"limits", limits_json(plan.limits)}});
  return json.dump(2) + "\n";
}

}  // namespace rvbench::sequences
