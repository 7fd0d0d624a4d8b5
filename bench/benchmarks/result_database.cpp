#include "bench/result_database.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/results/trend.hpp"

namespace {

using namespace rvbench;

// The matrix of the acceptance: 21 points, three repeats each.
constexpr std::array speeds_rpm{605, 1210, 1815};
constexpr std::array loads_pct{0, 25, 50, 75, 100, 125, 150};
constexpr int runs = 1000, repeats = 3, channels = 12;

// A fifth of what a record of the RV-20E shows, a measure of each band among it: what is not asked
// for lies elsewhere in the file.
std::vector<analysis::Indicator> indicators_of(int run) {
  std::vector<analysis::Indicator> indicators{{"acceleration_peak", "", 1 + 0.001 * run, "1"},
                                              {"kurtosis", "", 3 + 0.001 * run, "1"}};
  for (int band = 0; band < 6; ++band) {
    indicators.push_back({"band_rms", fmt::format("band {}", band), 1 + 0.001 * run, "1"});
  }
  return indicators;
}

bench::Judgement judgement_number(int run) {
  bench::Judgement judgement;
  judgement.ending = {Outcome::pass, ErrorKind::none, "no finding above its limit"};
  judgement.machine = "RV-20E";
  judgement.facts.serial = fmt::format("U{:04}", run);
  judgement.facts.started_utc =
      fmt::format("2026{:02}{:02}T{:02}0000Z", 1 + run / 84 % 12, 1 + run / 3 % 28, run % 3);
  judgement.facts.plan = "rv20e_acceptance";
  bench::JudgedPoint point;
  for (int c = 0; c < channels; ++c) {
    auto& channel = point.examination.channels.emplace_back();
    channel.name = fmt::format("accel_{}", c);
    channel.indicators = indicators_of(run);
  }
  for (const int speed_rpm : speeds_rpm) {
    for (int i = 0; i < repeats * int(loads_pct.size()); ++i) {
      point.planned_speed_rpm = speed_rpm;
      point.examination.load_pct = loads_pct[std::size_t(i) % loads_pct.size()];
      judgement.points.push_back(point);
    }
  }
  return judgement;
}

// A folder of a thousand runs that have been entered; gone at the program's end.
class ThousandRuns {
 public:
  ThousandRuns() {
    std::string name = (std::filesystem::temp_directory_path() / "rvbench-runs-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    root = name;
    auto database = bench::ResultDatabase::open(root);
    if (!database) std::abort();
    bench::ResultDatabase results = std::move(database).value();
    for (int run = 0; run < runs; ++run) {
      const bench::Judgement judgement = judgement_number(run);
      const auto folder = root / judgement.facts.serial / judgement.facts.started_utc;
      std::filesystem::create_directories(folder);
      if (!results.enter(bench::row_of(root, folder, judgement), judgement)) std::abort();
    }
  }
  ~ThousandRuns() { std::filesystem::remove_all(root); }
  ThousandRuns(const ThousandRuns&) = delete;
  ThousandRuns& operator=(const ThousandRuns&) = delete;

  std::filesystem::path root;
};

bench::ResultDatabase opened() {
  static const ThousandRuns thousand;
  auto database = bench::ResultDatabase::open(thousand.root);
  if (!database || !database.value().runs()) std::abort();
  return std::move(database).value();
}

void history_of_thousand_runs(benchmark::State& state) {
  opened();
  for (auto _ : state) {
    bench::ResultDatabase database = opened();
    if (!database.catch_up()) std::abort();
    if (database.runs().value().size() != runs) std::abort();
  }
  state.SetLabel("limit 0.2 s");
}
BENCHMARK(history_of_thousand_runs)->Unit(benchmark::kMillisecond);

// With the line through it, and the document that is told.
void trend_of_thousand_runs(benchmark::State& state, bench::SeriesOf asked) {
  opened();
  asked.measure = "band_rms";
  for (auto _ : state) {
    bench::ResultDatabase database = opened();
    if (!database.catch_up()) std::abort();
    const bench::Trend trend = bench::trend_of(asked, database.series(asked).value());
    if (trend.values.size() != runs) std::abort();
    benchmark::DoNotOptimize(bench::trend_to_json(trend));
  }
  state.SetLabel("63 points of 12 channels; limit 0.2 s");
}
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_a_band, bench::SeriesOf{.of = "band 2"})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_all_bands, bench::SeriesOf{})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_a_band_at_a_point,
                  bench::SeriesOf{.of = "band 2", .at = {1815, 100}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_all_bands_at_a_point,
                  bench::SeriesOf{.at = {1815, 100}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_all_bands_of_a_channel,
                  bench::SeriesOf{.channel = "accel_3"})
    ->Unit(benchmark::kMillisecond);

}  // namespace
