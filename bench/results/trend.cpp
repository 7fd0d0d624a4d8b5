#include "bench/results/trend.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "bench/json_text.hpp"
#include "bench/limit_checks.hpp"
#include "bench/results/run_filter.hpp"
#include "hal/json_object.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

constexpr double fastest_rpm = 10000, heaviest_pct = 300;  // as plans have it

// NaN is in no range.
std::optional<double> number_of(std::string_view text, double most) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number >= 0 && number <= most ? std::optional(number) : std::nullopt;
}

nlohmann::ordered_json slope_json(const Trend& trend) {
  if (!trend.per_day) return hal::json_object({{"told", false}, {"why_not", trend.why_not}});
  const analysis::SlopeOverTime& line = *trend.per_day;
  return hal::json_object({{"told", line.is_told()},
                           {"slope_per_day", line.slope},
                           {"ci95_per_day", {line.low, line.high}},
                           {"level", line.level},
                           {"variance_widened_by", line.dependence}});
}

}  // namespace

std::optional<SetPoint> point_of_text(const std::string& text) {
  const auto at = text.find('/');
  if (at == std::string::npos) return std::nullopt;
  const std::string_view all = text;
  const auto speed_rpm = number_of(all.substr(0, at), fastest_rpm);
  const auto load_pct = number_of(all.substr(at + 1), heaviest_pct);
  if (!speed_rpm || !load_pct) return std::nullopt;
  return SetPoint{speed_rpm, load_pct};
}

Trend trend_of(SeriesOf asked, std::vector<RunValue> values) {
  Trend trend;
  trend.asked = std::move(asked);
  if (!values.empty()) trend.unit = values.back().unit;
  std::vector<double> days, numbers;
  for (RunValue& value : values) {
    const auto day = days_of_utc(value.started_utc);
    value.value = in_unit(value.value, value.unit, trend.unit);
    if (!day || !std::isfinite(value.value)) continue;
    value.unit = trend.unit;
    days.push_back(*day);
    numbers.push_back(value.value);
    trend.values.push_back(std::move(value));
  }
  if (days.size() > analysis::most_for_slope) {
    const auto old = static_cast<std::ptrdiff_t>(days.size() - analysis::most_for_slope);
    days.erase(days.begin(), days.begin() + old);
    numbers.erase(numbers.begin(), numbers.begin() + old);
  }
  if (days.size() < analysis::fewest_for_slope) {
    trend.why_not = fmt::format("{} run{}, {} are needed", days.size(), days.size() == 1 ? "" : "s",
                                analysis::fewest_for_slope);
  } else if (days.front() == days.back()) {
    trend.why_not = "all runs began at one time";
  } else {
    trend.per_day = analysis::theil_sen(days, numbers);
  }
  return trend;
}

std::string trend_sentence(const Trend& trend) {
  if (!trend.per_day) return "no trend can be told: " + trend.why_not;
  constexpr double days = 30;
  const analysis::SlopeOverTime& line = *trend.per_day;
  const std::string interval =
      fmt::format("95 %: {:.3g} to {:.3g}{}", days * line.low, days * line.high,
                  line.dependence > 1 ? ", neighbours are alike" : "");
  if (!line.is_told()) {
    return fmt::format("no trend can be told: {} per {:.0f} days ({})",
                       with_unit(days * line.slope, trend.unit), days, interval);
  }
  return fmt::format("{} by {} per {:.0f} days ({})", line.slope > 0 ? "rises" : "falls",
                     with_unit(days * std::abs(line.slope), trend.unit), days, interval);
}

std::string trend_title(const Trend& trend) {
  const SeriesOf& asked = trend.asked;
  std::string title = asked.measure;
  if (!asked.of.empty()) title += " of " + asked.of;
  if (!asked.at.is_any()) title += ", " + text_of(asked.at);
  if (!asked.channel.empty()) title += ", " + asked.channel;
  if (!asked.serial.empty()) title += ", unit " + asked.serial;
  return title;
}

std::string trend_to_json(const Trend& trend) {
  auto values = nlohmann::ordered_json::array();
  for (const RunValue& value : trend.values) {
    values.push_back(hal::json_object({{"folder", value.folder},
                                       {"serial", value.serial},
                                       {"started_utc", value.started_utc},
                                       {"verdict", value.verdict},
                                       {"value", value.value},
                                       {"of", json_or_null(value.of)},
                                       {"point", value.point},
                                       {"channel", json_or_null(value.channel)}}));
  }
  const SeriesOf& asked = trend.asked;
  const nlohmann::ordered_json json =
      hal::json_object({{"indicator", asked.measure},
                        {"unit", json_or_null(trend.unit)},
                        {"of", json_or_null(asked.of)},
                        {"speed_rpm", json_or_null(asked.at.speed_rpm)},
                        {"load_pct", json_or_null(asked.at.load_pct)},
                        {"channel", json_or_null(asked.channel)},
                        {"serial", json_or_null(asked.serial)},
                        {"trend", slope_json(trend)},
                        {"sentence", trend_sentence(trend)},
                        {"values", values}});
  return json_text(json);
}

}  // namespace rvbench::bench
