#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "bench/commands/commands.hpp"
#include "bench/result_database.hpp"
#include "bench/results/history_table.hpp"
#include "bench/results/keep_newest.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/results/unentered_runs.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/measure.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::bench {
namespace {

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

// Of units whose folders nobody may read, nothing is known.
void warn_of_unreadable(Console& console, const std::filesystem::path& root) {
  for (const std::filesystem::path& unit : folders_in(root)) {
    std::error_code error;
    const std::filesystem::directory_iterator opened(unit, error);
    if (!error) continue;
    console.err << "rvbench: warning: " << unit.string() << " cannot be read: " << error.message()
                << '\n';
  }
}

std::vector<std::string> outcome_words() {
  std::vector<std::string> words;
  for (const Outcome outcome : all_outcomes) words.emplace_back(to_string(outcome));
  return words;
}

// What is entered of every run with a result; the runs of --indicator and --component alone.
Result<History> entered_in(Result<ResultDatabase> opened, const SeriesOf& series,
                           const std::string& component) {
  auto whole = caught_up(std::move(opened));
  if (!whole) return whole.error();
  const ResultDatabase database = std::move(whole).value();
  auto runs = database.runs();
  const auto later = database.later_judgements();
  if (!runs) return runs.error();
  if (!later) return later.error();
  History history{std::move(runs).value(), {}, {}};
  for (const JudgementRow& row : later.value()) history.later[row.folder].push_back(row);
  if (!component.empty()) {
    const auto with_finding = database.runs_with_finding(component);
    if (!with_finding) return with_finding.error();
    std::erase_if(history.runs,
                  [&](const RunRow& row) { return !with_finding.value().contains(row.folder); });
  }
  if (series.measure.empty()) return history;
  const auto values = database.series(series);
  if (!values) return values.error();
  for (const RunValue& value : values.value()) history.values.emplace(value.folder, value);
  std::erase_if(history.runs,
                [&](const RunRow& row) { return !history.values.contains(row.folder); });
  return history;
}

class HistoryCommand final : public Command {
 public:
  std::string name() const override { return "history"; }
  std::string summary() const override { return "the runs of a folder, or of one unit"; }
  std::string examples() const override {
    return "  rvbench history\n"
           "  rvbench history --serial A17 --json\n"
           "  rvbench history --from 2026-11-01 --verdict FAIL --component input_shaft\n"
           "  rvbench history --indicator acceleration_peak --last 20\n"
           "Runs that are not in the folder's results.db yet are entered first; without the\n"
           "right to write there, all are read from their folders. One without a result has the\n"
           "verdict - (null with --json). What rvbench rejudge made of a run stands below it.\n";
  }
  std::vector<Option> options() override {
    return {{"--serial", "of this unit only", &filter_.serial},
            {"--from", "begun then or later [UTC], as 2026-11-21 or \"2026-11-21 11:45\"", &from_},
            {"--to", "begun then or earlier [UTC]; a day counts to its end", &to_},
            {"--verdict", "that were judged so when they ended", &filter_.verdict, false,
             outcome_words()},
            {"--plan", "of this plan only", &filter_.plan},
            {"--indicator", "that have this measure, with its worst value", &indicator_},
            {"--component", "with a finding above its limit on this part", &component_},
            {"--last", "only the newest, so many", &last_, false, {}, UINT64_MAX, 1},
            {"--out", "folder of run folders; default: " + out_, &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }

  int run(Console& console) override;

 private:
  int read_filter(Console& console);
  void narrow(std::vector<RunRow>& rows) const;

  RunFilter filter_;
  std::string from_, to_;
  std::string indicator_;
  std::string component_;
  std::optional<std::uint64_t> last_;
  std::string out_ = "runs";
  bool json_ = false;
};

int HistoryCommand::read_filter(Console& console) {
  const auto refused = [&](const char* option, const std::string& text) {
    return refuse_usage(console, fmt::format("history: {} {}: no time as 2026-11-21 or "
                                             "\"2026-11-21 11:45\"",
                                             option, hal::in_quotes(text)));
  };
  const auto from = utc_of_text(from_, false), to = utc_of_text(to_, true);
  if (!from_.empty() && !from) return refused("--from", from_);
  if (!to_.empty() && !to) return refused("--to", to_);
  filter_.from_utc = from.value_or("");
  filter_.to_utc = to.value_or("");
  return indicator_.empty() || find_measure(indicator_) != nullptr
             ? exit_codes::done
             : refuse_measure(console, "history", indicator_);
}

void HistoryCommand::narrow(std::vector<RunRow>& rows) const {
  std::erase_if(rows, [&](const RunRow& row) { return !matches(filter_, row); });
  keep_newest(rows, last_);
  for (RunRow& row : rows) {
    std::error_code unknown;
    if (std::filesystem::exists(std::filesystem::path(out_) / row.folder, unknown)) continue;
    row.reason += row.reason.empty() ? "its folder is gone" : " (its folder is gone)";
  }
}

int HistoryCommand::run(Console& console) {
  std::error_code unknown;
  if (!std::filesystem::is_directory(out_, unknown)) {
    return refuse_usage(console, "history: no folder " + out_);
  }
  if (const int refused = read_filter(console); refused != exit_codes::done) return refused;
  const Measure* measure = find_measure(indicator_);
  const SeriesOf series{.measure = indicator_,
                        .serial = filter_.serial,
                        .least = measure != nullptr && measure->worst_is_least};
  // Before those with a result: a run that ends in between is in both lists, not in neither.
  const std::vector<RunRow> unfinished = unfinished_runs(out_);
  auto entered = entered_in(ResultDatabase::open(out_), series, component_);
  if (!entered) {
    console.err << "rvbench: warning: " << describe(entered.error())
                << "; the runs are read from their folders\n";
    entered = entered_in(ResultDatabase::in_memory(out_), series, component_);
  }
  if (!entered) return refuse_data(console, "history: " + describe(entered.error()));
  warn_of_unreadable(console, out_);
  History history = std::move(entered).value();
  // A run without a result has neither a value nor a finding.
  if (indicator_.empty() && component_.empty()) {
    history.runs = merged(std::move(history.runs), unfinished, out_);
  }
  narrow(history.runs);
  if (json_) {
    console.out << history_to_json(history);
    return exit_codes::done;
  }
  print_history(console, history);
  if (!history.runs.empty()) return exit_codes::done;
  const bool asks_for_some = filter_ != RunFilter() || !indicator_.empty() || !component_.empty();
  console.out << (asks_for_some ? "no such run in " : "no run yet in ") << out_ << '\n';
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_history_command() { return std::make_unique<HistoryCommand>(); }

}  // namespace rvbench::bench
