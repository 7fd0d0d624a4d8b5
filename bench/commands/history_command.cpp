#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/commands/commands.hpp"
#include "bench/result_database.hpp"
#include "bench/sha256.hpp"

namespace rvbench::bench {
namespace {

constexpr int widest_name = 32;
constexpr int longest_reason = 500;

// "2026-11-21 11:45:59" of "20261121T114559Z"; as it is, if it is written otherwise.
std::string readable(const std::string& utc) {
  if (utc.size() < 15 || utc[8] != 'T') return utc;
  return fmt::format("{}-{}-{} {}:{}:{}", utc.substr(0, 4), utc.substr(4, 2), utc.substr(6, 2),
                     utc.substr(9, 2), utc.substr(11, 2), utc.substr(13, 2));
}

nlohmann::ordered_json json_or_null(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

std::string as_json(const std::vector<RunRow>& rows) {
  auto runs = nlohmann::ordered_json::array();
  for (const RunRow& row : rows) {
    runs.push_back({{"folder", row.folder},
                    {"serial", row.serial},
                    {"started_utc", row.started_utc},
                    {"plan", row.plan},
                    {"verdict", json_or_null(row.verdict)},
                    {"error_kind", json_or_null(row.error_kind)},
                    {"reason", row.reason},
                    {"software", json_or_null(row.software)}});
  }
  return nlohmann::ordered_json{{"runs", runs}}.dump(2, ' ', false,
                                                     nlohmann::json::error_handler_t::replace) +
         "\n";
}

std::string padded(const std::string& cell, int columns) {
  return cell + std::string(std::size_t(std::max(0, columns - shown_width(cell))), ' ');
}

// @param none  what to say if there are none
void print(Console& console, const std::vector<RunRow>& rows, const std::string& none) {
  int serial_columns = 6, plan_columns = 4;
  for (const RunRow& row : rows) {
    serial_columns = std::max(serial_columns, shown_width(as_cell(row.serial, widest_name)));
    plan_columns = std::max(plan_columns, shown_width(as_cell(row.plan, widest_name)));
  }
  console.out << fmt::format("{:<19}  {}  {}  {:<7}  reason\n", "started (UTC)",
                             padded("serial", serial_columns), padded("plan", plan_columns),
                             "verdict");
  for (const RunRow& row : rows) {
    const Tone tone = row.verdict == "PASS"   ? Tone::good
                      : row.verdict == "FAIL" ? Tone::bad
                                              : Tone::warning;
    const std::string verdict = padded(row.verdict.empty() ? "-" : row.verdict, 7);
    console.out << fmt::format("{:<19}  {}  {}  {}  {}\n", readable(row.started_utc),
                               padded(as_cell(row.serial, widest_name), serial_columns),
                               padded(as_cell(row.plan, widest_name), plan_columns),
                               paint(console, tone, verdict), as_cell(row.reason, longest_reason));
  }
  if (rows.empty()) console.out << none << '\n';
}

// Those with a result, and those without: also of one that is resumed just now, but not of one that
// has come to its end since it was seen without.
std::vector<RunRow> merged(std::vector<RunRow> judged, const std::vector<RunRow>& unfinished,
                           const std::filesystem::path& root) {
  for (const RunRow& row : damaged_runs(root, judged)) judged.push_back(row);
  for (const RunRow& row : unfinished) {
    const auto old = std::ranges::find(judged, row.folder, &RunRow::folder);
    if (old != judged.end() && has_sums(root / row.folder)) continue;
    if (old != judged.end()) judged.erase(old);
    judged.push_back(row);
  }
  std::ranges::stable_sort(judged, {}, &RunRow::started_utc);
  return judged;
}

// Of every run with a result.
Result<std::vector<RunRow>> entered_in(Result<ResultDatabase> database) {
  if (!database) return database.error();
  ResultDatabase results = std::move(database).value();
  const auto caught_up = results.catch_up();
  if (!caught_up) return caught_up.error();
  return results.runs();
}

class HistoryCommand final : public Command {
 public:
  std::string name() const override { return "history"; }
  std::string summary() const override { return "the runs of a folder, or of one unit"; }
  std::string examples() const override {
    return "  rvbench history\n"
           "  rvbench history --serial A17 --json\n"
           "Runs that are not in the folder's results.db yet are entered first; without the\n"
           "right to write there, all are read from their folders. One without a result has the\n"
           "verdict - (null with --json).\n";
  }
  std::vector<Option> options() override {
    return {{"--serial", "of this unit only", &serial_},
            {"--out", "folder of run folders; default: " + out_, &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }

  int run(Console& console) override {
    std::error_code unknown;
    if (!std::filesystem::is_directory(out_, unknown)) {
      return refuse_usage(console, "history: no folder " + out_);
    }
    // Before those with a result: a run that ends in between is in both lists, not in neither.
    const std::vector<RunRow> unfinished = unfinished_runs(out_);
    auto rows = entered_in(ResultDatabase::open(out_));
    if (!rows) {
      console.err << "rvbench: warning: " << describe(rows.error())
                  << "; the runs are read from their folders\n";
      rows = entered_in(ResultDatabase::in_memory(out_));
    }
    if (!rows) return refuse_data(console, "history: " + describe(rows.error()));
    std::vector<RunRow> all = merged(std::move(rows).value(), unfinished, out_);
    std::erase_if(all,
                  [&](const RunRow& row) { return !serial_.empty() && row.serial != serial_; });
    if (json_) {
      console.out << as_json(all);
    } else {
      print(console, all, serial_.empty() ? "no run yet" : "no run of " + serial_ + " in " + out_);
    }
    return exit_codes::done;
  }

 private:
  std::string serial_;
  std::string out_ = "runs";
  bool json_ = false;
};

}  // namespace

std::unique_ptr<Command> make_history_command() { return std::make_unique<HistoryCommand>(); }

}  // namespace rvbench::bench
