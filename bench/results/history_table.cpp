#include "bench/results/history_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/json_text.hpp"
#include "bench/limit_checks.hpp"
#include "bench/results/run_filter.hpp"
#include "hal/json_object.hpp"

namespace rvbench::bench {
namespace {

constexpr int widest_serial = 64, widest_plan = 32;
constexpr int least_plan = 11;  // that is left of a long one: room for later_plan
constexpr int longest_reason = 500;
constexpr int least_reason = 20;  // beside the other columns, else below them
constexpr int time_columns = 19, verdict_columns = 7, between = 2;
constexpr const char* later_plan = "  re-judged";  // in place of the plan

nlohmann::ordered_json later_json(const History& history, const std::string& folder) {
  auto list = nlohmann::ordered_json::array();
  const auto later = history.later.find(folder);
  if (later == history.later.end()) return list;
  for (const JudgementRow& row : later->second) {
    list.push_back(hal::json_object({{"file", row.file},
                                     {"judged_utc", row.judged_utc},
                                     {"verdict", row.verdict},
                                     {"error_kind", row.error_kind},
                                     {"reason", row.reason},
                                     {"software", row.software},
                                     {"limits_version", json_or_null(row.limits_version)}}));
  }
  return list;
}

std::string painted(const Console& console, const std::string& verdict) {
  const Tone tone = verdict == "PASS" ? Tone::good : verdict == "FAIL" ? Tone::bad : Tone::warning;
  return paint(console, tone, padded(verdict.empty() ? "-" : verdict, 7));
}

// At blanks; a word that is longer than a line has one of its own.
std::vector<std::string> wrapped(const std::string& text, int columns) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (lines.empty() || shown_width(lines.back()) + 1 + shown_width(word) > columns) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

class HistoryTable {
 public:
  HistoryTable(Console& console, const History& history) : console_(console), history_(history) {
    if (!history.later.empty()) plan_columns_ = shown_width(later_plan);
    for (const RunRow& row : history.runs) {
      serial_columns_ = std::max(serial_columns_, shown_width(as_cell(row.serial, widest_serial)));
      plan_columns_ = std::max(plan_columns_, shown_width(as_cell(row.plan, widest_plan)));
    }
    if (console.out_columns == 0) return;
    const int beyond = reason_column() - between - console.out_columns;
    const int least = std::min(plan_columns_, least_plan);
    if (beyond > 0) plan_columns_ = std::max(least, plan_columns_ - beyond);
  }

  void print() const {
    print_row("started (UTC)", "serial", "plan", "verdict",
              history_.values.empty() ? "reason" : "value, reason");
    for (const RunRow& row : history_.runs) {
      print_row(readable_utc(row.started_utc), row.serial, row.plan, painted(console_, row.verdict),
                value_text(row) + row.reason);
      const auto later = history_.later.find(row.folder);
      if (later == history_.later.end()) continue;
      for (const JudgementRow& again : later->second) print_later(again);
    }
  }

 private:
  void print_row(const std::string& time, const std::string& serial, const std::string& plan,
                 const std::string& verdict, const std::string& reason) const {
    console_.out << fmt::format("{:<{}}  {}  {}  {}", time, time_columns,
                                padded(as_cell(serial, widest_serial), serial_columns_),
                                padded(as_cell(plan, plan_columns_), plan_columns_), verdict);
    print_reason(as_cell(reason, longest_reason));
  }

  int reason_column() const {
    return time_columns + serial_columns_ + plan_columns_ + verdict_columns + 4 * between;
  }

  void print_reason(const std::string& reason) const {
    const int columns = console_.out_columns;
    if (columns == 0 || reason_column() + shown_width(reason) <= columns) {
      console_.out << "  " << reason << '\n';
      return;
    }
    const bool is_beside = columns - reason_column() >= least_reason;
    const int indent = is_beside ? reason_column() : 2 * between;
    const std::string margin(std::size_t(indent), ' ');
    const auto lines = wrapped(reason, columns - indent);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      console_.out << (i > 0 ? margin : is_beside ? "  " : "\n" + margin) << lines[i] << '\n';
    }
    if (lines.empty()) console_.out << '\n';
  }

  void print_later(const JudgementRow& row) const {
    const std::string by = row.limits_version.empty() ? "by rvbench " + row.software
                                                      : "by limits " + row.limits_version;
    print_row(readable_utc(row.judged_utc), "", later_plan, painted(console_, row.verdict),
              by + ": " + row.reason);
  }

  std::string value_text(const RunRow& row) const {
    const auto value = history_.values.find(row.folder);
    if (value == history_.values.end()) return "";
    return with_unit(value->second.value, value->second.unit) + ", ";
  }

  Console& console_;
  const History& history_;
  int serial_columns_ = 6, plan_columns_ = 4;
};

}  // namespace

std::string history_to_json(const History& history) {
  auto runs = nlohmann::ordered_json::array();
  for (const RunRow& row : history.runs) {
    runs.push_back(hal::json_object({{"folder", row.folder},
                                     {"serial", row.serial},
                                     {"started_utc", row.started_utc},
                                     {"plan", row.plan},
                                     {"verdict", json_or_null(row.verdict)},
                                     {"error_kind", json_or_null(row.error_kind)},
                                     {"reason", row.reason},
                                     {"software", json_or_null(row.software)},
                                     {"rejudged", later_json(history, row.folder)}}));
    const auto value = history.values.find(row.folder);
    if (value == history.values.end()) continue;
    runs.back()["indicator"] = hal::json_object({{"value", value->second.value},
                                                 {"unit", value->second.unit},
                                                 {"of", json_or_null(value->second.of)},
                                                 {"point", value->second.point},
                                                 {"channel", json_or_null(value->second.channel)}});
  }
  return json_text(hal::json_object({{"runs", runs}}));
}

void print_history(Console& console, const History& history) {
  HistoryTable(console, history).print();
}

}  // namespace rvbench::bench
