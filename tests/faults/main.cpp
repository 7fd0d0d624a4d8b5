#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/faults/fault_run.hpp"
#include "tests/faults/kept_recording.hpp"
#include "tests/faults/wall_clock.hpp"
#include "tests/support/scratch_folder.hpp"

namespace {

using namespace rvbench;

constexpr int states = test::bench_states;
constexpr int most_attempts = 10;         // at a run that the computer holds up
constexpr double repeated_share = 0.005;  // of the runs, at most

struct Options {
  int runs = 500;
  int first = 0;
  std::uint64_t seed = 1;
  int jobs = 8;  // most of the time they wait for replies that do not come
  std::string without;
  std::string only;
};

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

// Every kind in every state in turn, each time with another seed; one in twenty is a sound bench.
test::FaultCase case_of(const Options& options, int number) {
  const std::uint64_t seed = options.seed * 1'000'003 + std::uint64_t(number);
  if (options.only.empty() && number % 20 == 19) return {.seed = seed};
  std::vector<const test::FaultKind*> kinds;
  for (const test::FaultKind& kind : test::fault_kinds()) {
    if (options.only.empty() || kind.name == options.only) kinds.push_back(&kind);
  }
  const auto at = std::size_t(number);
  return {kinds.at(at % kinds.size()), test::BenchState(at / kinds.size() % states), seed};
}

std::string name_of(const test::FaultCase& fault) {
  if (fault.kind == nullptr) return fmt::format("sound bench, seed {}", fault.seed);
  return fmt::format("{} while {}, seed {}", fault.kind->name, to_string(fault.state), fault.seed);
}

struct Attempted {
  test::FaultReport report;
  int repeated = 0;
  bool is_judged() const { return !report.held_up; }
};

// A run that the computer held up proves nothing, neither good nor bad.
Attempted attempt(const test::FaultCase& fault, const std::filesystem::path& folder,
                  const test::Guard* without) {
  Attempted run{run_fault(fault, folder, without)};
  while (run.report.held_up && run.repeated + 1 < most_attempts) {
    ++run.repeated;
    run.report = run_fault(fault, folder, without);
  }
  return run;
}

// Prints one line per run for the parent: struck, repeated, undriven, released, violations.
void work(const Options& options, int job, std::FILE* out) {
  const test::Guard* without = nullptr;
  for (const test::Guard& guard : test::guards()) {
    if (guard.name == options.without) without = &guard;
  }
  const test::ScratchFolder folder(test::where_recordings_are_kept());
  for (int number = options.first + job; number < options.first + options.runs;
       number += options.jobs) {
    const test::FaultCase fault = case_of(options, number);
    const Attempted run = attempt(fault, folder.path(), without);
    if (!run.is_judged()) {
      fmt::print(out, "? {}\n", name_of(fault));
      std::fflush(out);
      continue;
    }
    const test::FaultReport& report = run.report;
    fmt::print(out, "{} {} {} {} {}\n", report.struck ? 1 : 0, run.repeated, report.undriven_s,
               report.released_s,
               fault.kind == nullptr                             ? "-"
               : fault.kind->answer == test::Answer::safety_trip ? "trip"
                                                                 : "other");
    for (const std::string& violation : report.violations) {
      fmt::print(out, "! {}: {} [{}]\n", name_of(fault), violation, report.outcome);
    }
    std::fflush(out);
  }
}

struct Totals {
  int runs = 0, struck = 0, repeated = 0, violations = 0;
  int not_judged = 0;  // the computer held up every attempt
  double worst_trip_s = 0, worst_released_s = -1e9;
};

double most_repeated(const Totals& totals) { return std::ceil(repeated_share * totals.runs); }

void take(const std::string& line, const Options& options, Totals& totals) {
  if (line.starts_with("! ")) {
    ++totals.violations;
    if (totals.violations <= 40) fmt::print("VIOLATION {}", line.substr(2));
    std::fflush(stdout);
    return;
  }
  if (line.starts_with("? ")) {
    ++totals.not_judged;
    fmt::print("NOT JUDGED, the computer is too busy: {}", line.substr(2));
    std::fflush(stdout);
    return;
  }
  int struck = 0, repeated = 0;
  double undriven_s = 0, released_s = 0;
  char answer[16] = "";
  if (std::sscanf(line.c_str(), "%d %d %lf %lf %15s", &struck, &repeated, &undriven_s, &released_s,
                  answer) != 5) {
    return;
  }
  ++totals.runs;
  totals.struck += struck;
  totals.repeated += repeated;
  if (std::string(answer) == "trip")
    totals.worst_trip_s = std::max(totals.worst_trip_s, undriven_s);
  if (released_s > totals.worst_released_s) totals.worst_released_s = released_s;
  if (totals.runs % 100 == 0) {
    fmt::print(stderr, "{} of {} runs, {} violations\n", totals.runs, options.runs,
               totals.violations);
  }
}

// Starts the processes that share the runs. @return where each tells of its own
std::FILE* start_workers(const Options& options) {
  int ends[2];
  if (::pipe(ends) != 0) return nullptr;
  for (int job = 0; job < options.jobs; ++job) {
    if (::fork() != 0) continue;
    ::close(ends[0]);
    std::FILE* out = ::fdopen(ends[1], "w");
    work(options, job, out);
    std::fclose(out);
    ::_exit(0);
  }
  ::close(ends[1]);
  return ::fdopen(ends[0], "r");
}

// @return how many of them did not come to their end
int failed_workers() {
  int failed = 0;
  for (int status = 0; ::wait(&status) > 0;) failed += status == 0 ? 0 : 1;
  return failed;
}

void print(const Totals& totals, double took_s) {
  fmt::print(
      "{} kinds in {} states: {} runs in {:.0f} s, {} struck\n"
      "violations                        {:8}   limit 0\n"
      "repeated, the computer was busy   {:8}   limit {:.0f}\n"
      "interlock to stop obeyed, worst    {:7.3f} s limit 0.025 s, virtual time\n"
      "brake held after standstill, worst {:7.3f} s limit 0.210 s, virtual time\n",
      test::fault_kinds().size(), states, totals.runs, took_s, totals.struck, totals.violations,
      totals.repeated, most_repeated(totals), totals.worst_trip_s, totals.worst_released_s);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--runs", options.runs, "how many");
  app.add_option("--first", options.first, "number of the first, to see one of them again");
  app.add_option("--seed", options.seed, "of when faults strike");
  app.add_option("--jobs", options.jobs, "processes side by side")->check(CLI::Range(1, 64));
  app.add_option("--without", options.without, "guard that is switched off")
      ->check(CLI::IsMember(names_of(test::guards())));
  app.add_option("--only", options.only, "one kind of fault")
      ->check(CLI::IsMember(names_of(test::fault_kinds())));
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Fault campaign: every fault in every state of a run, judged by the plant."};
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  if (!test::wall_clock_can_step()) {
    fmt::print("the wall clock cannot be stepped here: nothing would be shown by it\n");
    return 1;
  }
  const auto began = std::chrono::steady_clock::now();
  std::FILE* told = start_workers(options);
  if (told == nullptr) return 1;
  Totals totals;
  char line[4096];
  while (std::fgets(line, sizeof line, told) != nullptr) take(line, options, totals);
  const int failed = failed_workers();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  print(totals, took.count());
  if (failed > 0 || totals.runs + totals.not_judged != options.runs) {
    fmt::print("{} workers failed; {} runs of {} came to an end\n", failed, totals.runs,
               options.runs);
    return 1;
  }
  if (totals.not_judged > 0) return 1;
  return totals.violations == 0 && totals.repeated <= most_repeated(totals) ? 0 : 1;
}
