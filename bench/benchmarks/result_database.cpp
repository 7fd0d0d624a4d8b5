#include "bench/result_database.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace rvbench;

constexpr int runs = 1000, points = 4, channels = 12;

// What a record of the RV-20E shows: a measure of each band, some 40 values a channel.
std::vector<analysis::Indicator> indicators_of(int run) {
  std::vector<analysis::Indicator> indicators;
  for (const char* measure :
       {"acceleration_peak", "kurtosis", "crest_factor", "acceleration_rms"}) {
    indicators.push_back({measure, "", 1 + 0.001 * run, "1"});
  }
  for (const char* measure : {"band_rms", "band_peak", "band_kurtosis", "band_crest_factor",
                              "order_level", "envelope_order_level"}) {
    for (int band = 0; band < 6; ++band) {
      indicators.push_back({measure, fmt::format("band {}", band), 1 + 0.001 * run, "1"});
    }
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
  judgement.facts.plan = "quick";
  for (int p = 0; p < points; ++p) {
    bench::JudgedPoint& point = judgement.points.emplace_back();
    point.planned_speed_rpm = p < 2 ? 1210 : 1815;
    point.examination.load_pct = p % 2 == 0 ? 50 : 100;
    for (int c = 0; c < channels; ++c) {
      auto& channel = point.examination.channels.emplace_back();
      channel.name = fmt::format("accel_{}", c);
      channel.indicators = indicators_of(run);
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

// @param of  of six bands, or of each of them
void trend_of_thousand_runs(benchmark::State& state, const char* of) {
  opened();
  for (auto _ : state) {
    bench::ResultDatabase database = opened();
    if (!database.catch_up()) std::abort();
    if (database.series({.measure = "band_rms", .of = of}).value().size() != runs) std::abort();
  }
  state.SetLabel("limit 0.2 s");
}
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_a_band, "band 2")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(trend_of_thousand_runs, of_all_bands, "")->Unit(benchmark::kMillisecond);

}  // namespace
