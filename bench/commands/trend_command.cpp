#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "bench/commands/commands.hpp"
#include "bench/out_folder.hpp"
#include "bench/result_database.hpp"
#include "bench/results/keep_newest.hpp"
#include "bench/results/trend.hpp"
#include "bench/text_file.hpp"
#include "hal/did_you_mean.hpp"
#include "hal/types/measure.hpp"

namespace rvbench::bench {
namespace {

Result<std::vector<RunValue>> values_in(Result<ResultDatabase> opened, const SeriesOf& asked) {
  const auto database = caught_up(std::move(opened));
  if (!database) return database.error();
  return database.value().series(asked);
}

class TrendCommand final : public Command {
 public:
  std::string name() const override { return "trend"; }
  std::string summary() const override { return "one indicator over the runs, and its drift"; }
  std::string examples() const override {
    return "  rvbench trend acceleration_peak\n"
           "  rvbench trend band_rms --of \"sun-planet mesh\" --point 1210/50 --channel accel_1x\n"
           "  rvbench trend kurtosis --serial golden --out golden_kurtosis\n"
           "Of each run the worst value of what is asked for. A trend is told where the slope's\n"
           "95 % interval leaves 0 out; ten runs are the least it takes.\n";
  }
  std::vector<Option> options() override {
    return {{"INDICATOR", "a measure, as plans limit it", &measure_, true},
            {"--of", "of this band, order or mesh only", &asked_.of},
            {"--point", "at this speed and load only: RPM/PERCENT", &point_},
            {"--channel", "of this channel only", &asked_.channel},
            {"--serial", "of this unit only", &asked_.serial},
            {"--last", "of the newest runs only, so many", &last_, false, {}, UINT64_MAX, 1},
            {"--runs", "folder of run folders; default: " + runs_, &runs_},
            {"--out", "folder for trend.json and trend.html; default: none are written", &out_},
            {"--json", "one JSON document on standard output", &json_}};
  }
  int run(Console& console) override;

 private:
  std::string place_fault(bool is_point) const;

  std::string measure_;
  SeriesOf asked_;
  std::string point_;
  std::optional<std::uint64_t> last_;
  std::string runs_ = "runs";
  std::string out_;
  bool json_ = false;
};

// What is wrong with the point and channel that are asked for; "" if nothing.
std::string TrendCommand::place_fault(bool is_point) const {
  if (!point_.empty() && !is_point) {
    return "--point " + hal::in_quotes(point_) +
           ": state speed and load as 1210/50, in rpm up to 10000 and % up to 300";
  }
  if (measure_ == measure_names::modulation_depth && !(point_.empty() && asked_.channel.empty())) {
    return "a modulation depth is concluded from all points and channels together: leave out "
           "--point and --channel";
  }
  return "";
}

int TrendCommand::run(Console& console) {
  const Measure* measure = find_measure(measure_);
  if (measure == nullptr) return refuse_measure(console, "trend", measure_);
  asked_.measure = measure_;
  asked_.least = measure->worst_is_least;
  const auto point = point_of_text(point_);
  if (const std::string fault = place_fault(point.has_value()); !fault.empty()) {
    return refuse_usage(console, "trend: " + fault);
  }
  if (!point_.empty()) asked_.at = *point;
  std::error_code unknown;
  if (!std::filesystem::is_directory(runs_, unknown)) {
    return refuse_usage(console, "trend: no folder " + runs_);
  }
  OutFolder out;
  const std::string unusable = out_.empty() ? "" : out.make(out_, {"trend.json", "trend.html"});
  if (!unusable.empty()) return refuse_usage(console, "trend: --out " + out_ + ": " + unusable);
  auto values = values_in(ResultDatabase::open(runs_), asked_);
  if (!values) {
    console.err << "rvbench: warning: " << describe(values.error())
                << "; the runs are read from their folders\n";
    values = values_in(ResultDatabase::in_memory(runs_), asked_);
  }
  if (!values) return refuse_data(console, "trend: " + describe(values.error()));
  std::vector<RunValue> newest = std::move(values).value();
  keep_newest(newest, last_);
  const Trend trend = trend_of(asked_, std::move(newest));
  if (!out_.empty()) {
    write_file(std::filesystem::path(out_) / "trend.html", make_trend_page(trend));
    write_file(std::filesystem::path(out_) / "trend.json", trend_to_json(trend));
  }
  console.out << (json_ ? trend_to_json(trend) : trend_text(trend));
  return exit_codes::done;
}

}  // namespace

std::unique_ptr<Command> make_trend_command() { return std::make_unique<TrendCommand>(); }

}  // namespace rvbench::bench
