#include "bench/station/chart_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hal/formats/printable.hpp"

namespace rvbench::bench {
namespace {

constexpr std::size_t most_listed = 12;
constexpr int widest_label = 32;

std::string place_of(const ChartEvent& event, const ChartAnswer& answer) {
  return as_cell(answer.data.labels[std::size_t(event.at)], widest_label);
}

}  // namespace

std::vector<ChartEvent> events_of(const ChartAnswer& answer) {
  std::vector<ChartEvent> events;
  for (const analysis::RuleSignal& signal : answer.chart.signals) {
    events.push_back(
        {signal.at, std::string(signal.rule->name), std::string(signal.rule->meaning)});
  }
  for (const Eigen::Index at : answer.chart.wide_ranges) {
    events.push_back({at, "moving_range", "the step from the value before is above its limit"});
  }
  for (const Eigen::Index at : answer.ewma.out) {
    events.push_back({at, "ewma", "the weighted mean is beyond its limits"});
  }
  std::ranges::stable_sort(events, {}, &ChartEvent::at);
  return events;
}

std::string spoken_control(const ChartAnswer& answer) {
  return answer.is_in_control() ? "IN CONTROL" : "OUT OF CONTROL";
}

std::string chart_sentence(const ChartAnswer& answer) {
  const std::vector<ChartEvent> events = events_of(answer);
  if (events.empty()) {
    return fmt::format("Nothing but chance shows in {} values.", answer.data.values.size());
  }
  const ChartEvent& first = events.front();
  return fmt::format("First at {}: {} ({}). {} such {} in {} values.", place_of(first, answer),
                     first.meaning, first.rule, events.size(),
                     events.size() == 1 ? "signal" : "signals", answer.data.values.size());
}

std::vector<std::string> chart_warnings(const ChartAnswer& answer) {
  std::vector<std::string> warnings;
  if (answer.chart.baseline.points < analysis::good_baseline) {
    warnings.push_back(
        fmt::format("The baseline has {} values: its limits are uncertain, {} make a good one.",
                    answer.chart.baseline.points, analysis::good_baseline));
  }
  if (!answer.capability) return warnings;
  if (answer.capability->normality_p < analysis::least_normality_p) {
    warnings.push_back(fmt::format(
        "The values are not normal (Anderson-Darling, p = {:.2g}): Cpk, Ppk and their intervals "
        "do not tell the share beyond a limit.",
        answer.capability->normality_p));
  }
  if (!answer.is_in_control()) {
    warnings.emplace_back(
        "The process is not in control: an index says what was, not what will come.");
  }
  return warnings;
}

std::vector<std::string> capability_lines(const ChartAnswer& answer) {
  std::vector<std::string> lines;
  if (!answer.capability) return lines;
  const auto add = [&](const char* name, const analysis::CapabilityIndex& index) {
    lines.push_back(fmt::format("{} {:.2f} (95 %: {:.2f} to {:.2f})", name, index.value,
                                index.interval.low, index.interval.high));
  };
  const analysis::Capability& of = *answer.capability;
  if (of.cp) add("Cp ", *of.cp);
  add("Cpk", of.cpk);
  if (of.pp) add("Pp ", *of.pp);
  add("Ppk", of.ppk);
  return lines;
}

void print_chart(Console& console, const ChartAnswer& answer) {
  const analysis::ChartBaseline& baseline = answer.chart.baseline;
  console.out << paint(console, answer.is_in_control() ? Tone::good : Tone::bad,
                       spoken_control(answer))
              << "  " << chart_sentence(answer) << '\n'
              << fmt::format(
                     "centre {:.6g}, limits {:.6g} to {:.6g}, ranges to {:.6g}{}; from {} "
                     "values\n",
                     baseline.centre, baseline.lower(), baseline.upper(), baseline.upper_range(),
                     answer.data.unit.empty() ? ", unit not stated"
                                              : " " + hal::formats::printable(answer.data.unit),
                     baseline.points);
  const std::vector<ChartEvent> events = events_of(answer);
  for (std::size_t i = 0; i < std::min(events.size(), most_listed); ++i) {
    const ChartEvent& event = events[i];
    console.out << fmt::format("  {}  {:.6g}  {}: {}\n", place_of(event, answer),
                               answer.data.values[event.at], event.rule, event.meaning);
  }
  if (events.size() > most_listed) {
    console.out << fmt::format("  and {} more\n", events.size() - most_listed);
  }
  for (const std::string& line : capability_lines(answer)) console.out << line << '\n';
  for (const std::string& warning : chart_warnings(answer)) {
    console.out << paint(console, Tone::warning, warning) << '\n';
  }
}

}  // namespace rvbench::bench
