// How fast a station answers as its results grow, and whether its memory does.
//
//     rvbench_station_speed [--units 1000] [--plan quick]
//
// Runs one simulated unit, then enters as many alike as it is asked for, each by what the end of a
// run does, and asks a station that serves them meanwhile. Prints a line per figure, limits beside;
// the exit code is 1 where one is beyond. For a quiet machine: times are of the clock on the wall.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <map>
#include <vector>

#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_results.hpp"
#include "bench/run_start.hpp"
#include "bench/stored_run.hpp"
#include "tests/serve/served_station.hpp"
#include "tests/spec/rvbench.hpp"

namespace rvbench::test {
namespace {

constexpr double limit_ms = 200;
constexpr double limit_growth = 1.1;  // of resident memory
constexpr int rarely = 10;            // units between two questions, before the last hundred
constexpr int last_units = 100;
constexpr int first_units = 200;  // as many as one answer lists: it grows no more

// What the page asks when it is opened, and of its tabs.
const std::map<std::string, std::string> targets{
    {"page", "/"},
    {"history", "/api/history"},
    {"trend of all bands", "/api/trend?indicator=band_rms"},
    {"trend at a point", "/api/trend?indicator=acceleration_peak&point=1815/100"}};

double resident_MB(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    double kB = 0;
    if (word == "VmRSS:" && status >> kB) return kB / 1024;
  }
  return not_known;
}

bench::StoredRun simulated_unit(const ScratchFolder& scratch, const std::string& plan) {
  const Answer run =
      rvbench(scratch.path(), {"run", plan, "--rig", "sim", "--serial", "first", "--no-report"});
  if (run.code != 0) throw std::runtime_error("no run: " + run.err);
  const auto folder = std::filesystem::directory_iterator(scratch / "runs/first")->path();
  return std::get<bench::StoredRun>(bench::read_stored_run(folder));
}

// Another unit like that one: every number within some percent of its.
bench::Judgement unit_like(const bench::StoredRun& first, int number, const std::string& utc) {
  bench::Judgement judgement = first.as_judged;
  judgement.facts.serial = fmt::format("U{:04}", number);
  judgement.facts.started_utc = utc;
  const double factor = 1 + 0.05 * std::sin(double(number));
  for (bench::JudgedPoint& point : judgement.points) {
    for (auto& channel : point.examination.channels) {
      for (analysis::Indicator& indicator : channel.indicators) indicator.value *= factor;
    }
  }
  return judgement;
}

// As the end of a run does.
void leave_result(const std::filesystem::path& runs, const bench::StoredRun& first, int number) {
  const std::string serial = fmt::format("U{:04}", number);
  const std::string plan = sequences::plan_to_json(first.plan);
  const bench::RunPlace place = bench::begin_run(runs, serial, {{"plan.json", plan}});
  const std::string utc = bench::read_run_begin(place.folder).started_utc;
  const bench::Judgement judgement = unit_like(first, number, utc);
  const auto missing = bench::write_results(place.folder, judgement, first.kinematics, false);
  if (!missing.empty()) throw std::runtime_error("not written: " + missing.front());
  auto opened = bench::ResultDatabase::open(runs);
  if (!opened) throw std::runtime_error(describe(opened.error()));
  bench::ResultDatabase database = std::move(opened).value();
  const Status entered = database.enter(bench::row_of(runs, place.folder, judgement), judgement);
  if (!entered) throw std::runtime_error(describe(entered.error()));
  if (const auto all = database.catch_up(); !all) throw std::runtime_error(describe(all.error()));
}

double asked_ms(ServedStation& station, const std::string& target) {
  const auto begin = std::chrono::steady_clock::now();
  const HttpReply reply = station.get(target);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
  if (reply.status != 200) throw std::runtime_error(target + ": " + std::to_string(reply.status));
  return took.count();
}

// @return whether it is within
bool print_times(const std::string& what, std::vector<double> times_ms) {
  std::ranges::sort(times_ms);
  const double most_ms = times_ms.back();
  fmt::print("{:<20} {:8.1f} ms median, {:8.1f} ms at most; limit {:g} ms\n", what,
             times_ms[times_ms.size() / 2], most_ms, limit_ms);
  return most_ms <= limit_ms;
}

bool measure(const std::string& plan, int units) {
  const ScratchFolder scratch;
  ServedStation station(scratch, fmt::format(R"("plan": "{}")", plan));
  if (station.log_in("vera").status != 200) throw std::runtime_error("no login");
  const bench::StoredRun first = simulated_unit(scratch, plan);
  std::map<std::string, std::vector<double>> times_ms;
  double early_MB = not_known;
  for (int number = 1; number <= units; ++number) {
    leave_result(scratch / "runs", first, number);
    const bool is_last = number > units - last_units;
    if (is_last || number % rarely == 0) {
      for (const auto& [what, target] : targets) {
        const double time_ms = asked_ms(station, target);
        if (is_last) times_ms[what].push_back(time_ms);
      }
    }
    if (number == std::min(first_units, units)) early_MB = resident_MB(station.program().number());
  }
  const double late_MB = resident_MB(station.program().number());
  fmt::print("{} units of plan {}, {} points each; of the last {}:\n", units, plan,
             first.plan.points().size(), last_units);
  bool is_within = true;
  for (const auto& [what, times] : times_ms) is_within &= print_times(what, times);
  fmt::print("{:<20} {:8.1f} MB at {} units, {:.1f} MB at {}; limit {:g} times\n",
             "resident memory", early_MB, std::min(first_units, units), late_MB, units,
             limit_growth);
  return is_within && late_MB <= limit_growth * early_MB;
}

}  // namespace
}  // namespace rvbench::test

int main(int count, char** words) {
  CLI::App app{"How fast a station answers as its results grow"};
  int units = 1000;
  std::string plan = "quick";
  app.add_option("--units", units, "units to enter")->check(CLI::PositiveNumber);
  app.add_option("--plan", plan, "plan they are of");
  CLI11_PARSE(app, count, words);
  try {
    return rvbench::test::measure(plan, units) ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "rvbench_station_speed: {}\n", error.what());
    return 2;
  }
}
