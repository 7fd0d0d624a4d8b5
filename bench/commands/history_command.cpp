#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bench/commands/commands.hpp"
#include "bench/result_database.hpp"

namespace rvbench::bench {
namespace {

// "2026-11-21 11:45:59" of "20261121T114559Z"; as it is, if it is written otherwise.
std::string readable(const std::string& utc) {
  if (utc.size() < 15 || utc[8] != 'T') return utc;
  return fmt::format("{}-{}-{} {}:{}:{}", utc.substr(0, 4), utc.substr(4, 2), utc.substr(6, 2),
                     utc.substr(9, 2), utc.substr(11, 2), utc.substr(13, 2));
}

std::string as_json(const std::vector<RunRow>& rows) {
  auto runs = nlohmann::ordered_json::array();
  for (const RunRow& row : rows) {
    runs.push_back({{"folder", row.folder},
                    {"serial", row.serial},
                    {"started_utc", row.started_utc},
                    {"plan", row.plan},
                    {"verdict", row.verdict},
                    {"error_kind", row.error_kind},
                    {"reason", row.reason},
                    {"software", row.software}});
  }
  return nlohmann::ordered_json{{"runs", runs}}.dump(2, ' ', false,
                                                     nlohmann::json::error_handler_t::replace) +
         "\n";
}

void print(Console& console, const std::vector<RunRow>& rows) {
  int serial_columns = 6, plan_columns = 4;
  for (const RunRow& row : rows) {
    serial_columns = std::max(serial_columns, shown_width(row.serial));
    plan_columns = std::max(plan_columns, shown_width(row.plan));
  }
  const auto padded = [](const std::string& text, int columns) {
    return text + std::string(std::size_t(std::max(0, columns - shown_width(text))), ' ');
  };
  console.out << fmt::format("{:<19}  {}  {}  {:<7}  reason\n", "started (UTC)",
                             padded("serial", serial_columns), padded("plan", plan_columns),
                             "verdict");
  for (const RunRow& row : rows) {
    const Tone tone = row.verdict == "PASS"   ? Tone::good
                      : row.verdict == "FAIL" ? Tone::bad
                                              : Tone::warning;
    console.out << fmt::format("{:<19}  {}  {}  {}  {}\n", readable(row.started_utc),
                               padded(row.serial, serial_columns), padded(row.plan, plan_columns),
                               paint(console, tone, padded(row.verdict, 7)), row.reason);
  }
  if (rows.empty()) console.out << "no run yet\n";
}

class HistoryCommand final : public Command {
 public:
  std::string name() const override { return "history"; }
  std::string summary() const override { return "the runs of a folder, or of one unit"; }
  std::string examples() const override {
    return "  rvbench history\n"
           "  rvbench history --serial A17 --json\n"
           "Runs that are not in the folder's results.db yet are entered first.\n";
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
    auto database = ResultDatabase::open(out_);
    if (!database) return refuse_data(console, "history: " + describe(database.error()));
    ResultDatabase results = std::move(database).value();
    const auto caught_up = results.catch_up();
    if (!caught_up) return refuse_data(console, "history: " + describe(caught_up.error()));
    const auto rows = results.runs(serial_);
    if (!rows) return refuse_data(console, "history: " + describe(rows.error()));
    if (json_) {
      console.out << as_json(rows.value());
    } else {
      print(console, rows.value());
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
