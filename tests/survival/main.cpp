#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <sstream>

#include "tests/support/program.hpp"
#include "tests/survival/crashes.hpp"
#include "tests/survival/writing_process.hpp"

namespace {

using namespace rvbench;

constexpr int cuts_per_run = 125;  // of one recorded run

const std::map<std::string, test::Without> without_named{{"nothing", test::Without::nothing},
                                                         {"journal", test::Without::journal},
                                                         {"syncs", test::Without::syncs}};

struct Options {
  int kills = 100;
  int cuts = 100;
  int faults = 40;
  int jobs = 4;  // much of the time they wait for the disk, or for the pace of a run
  std::uint64_t seed = 1;
  std::string without = "nothing";
  int job = -1;  // of a worker
  test::RunLengths lengths;
};

void print(const char* kind, const test::Crash& crash) {
  const test::Aftermath& found = crash.aftermath;
  fmt::print("{} {} {} {} {} {} {}\n", kind, found.acknowledged_lost, found.stream_lost_s,
             found.blocks_lost, found.opens ? 0 : 1, found.resume_offered ? 0 : 1,
             found.violations.size());
  for (const std::string& violation : found.violations) {
    fmt::print("! {}: {}\n", crash.what, violation);
  }
}

// Does each of the job's crashes, and prints a line of figures about it, and its violations.
int work(const Options& options) {
  const auto share = [](int number, int all) { return (number + 0.5) / all; };
  const int first_case = static_cast<int>(options.seed) * 1'000'000;
  for (int n = options.job; n < options.kills; n += options.jobs) {
    print("kill", kill_run(options.lengths, share(n, options.kills), first_case + n));
  }
  for (int n = options.job; n < options.faults; n += options.jobs) {
    print("fault", fail_run(options.lengths, share(n, options.faults), first_case + n));
  }
  std::unique_ptr<test::RecordedRun> runs[2];
  int done = 0;
  for (int n = options.job; n < options.cuts; n += options.jobs, ++done) {
    auto& run = runs[done % 2];
    if (done % (2 * cuts_per_run) < 2) {
      run = std::make_unique<test::RecordedRun>(options.lengths, done % 2 == 1);
    }
    print("cut", run->cut(options.seed * 1'000'000 + static_cast<std::uint64_t>(n),
                          without_named.at(options.without)));
  }
  return 0;
}

struct Totals {
  int kills = 0, cuts = 0, faults = 0;
  int lost = 0, not_open = 0, not_offered = 0, violations = 0;
  int blocks_killed = 0;
  double stream_cut_s = 0;

  void take(const std::string& line) {
    if (line.starts_with("! ")) {
      fmt::print("VIOLATION {}\n", line.substr(2));
      return;
    }
    std::istringstream words(line);
    std::string kind;
    int lost_here = 0, blocks = 0, closed = 0, refused = 0, violated = 0;
    double stream_s = 0;
    if (!(words >> kind >> lost_here >> stream_s >> blocks >> closed >> refused >> violated))
      return;
    (kind == "kill" ? kills : kind == "cut" ? cuts : faults) += 1;
    lost += lost_here;
    not_open += closed;
    not_offered += refused;
    violations += violated;
    if (kind == "kill") blocks_killed = std::max(blocks_killed, blocks);
    if (kind == "cut") stream_cut_s = std::max(stream_cut_s, stream_s);
  }

  bool holds() const {
    return lost == 0 && not_open == 0 && not_offered == 0 && violations == 0 &&
           blocks_killed <= 1 && stream_cut_s <= 1;
  }
};

std::vector<std::string> worker_words(const Options& options, int job) {
  std::vector<std::string> words{std::filesystem::read_symlink("/proc/self/exe")};
  const auto add = [&words](const char* name, auto value) {
    words.insert(words.end(), {name, fmt::to_string(value)});
  };
  add("--kills", options.kills);
  add("--cuts", options.cuts);
  add("--faults", options.faults);
  add("--jobs", options.jobs);
  add("--seed", options.seed);
  add("--without", options.without);
  add("--job", job);
  add("--calls", options.lengths.whole);
  words.push_back(fmt::to_string(options.lengths.resumed));
  words.push_back(fmt::to_string(options.lengths.in_real_time));
  return words;
}

int report(const Options& options, const Totals& totals, double took_s) {
  fmt::print(
      "{} kills at any of {} calls of a run, {} of a resumed one or {} of one in real time, "
      "{} power cuts, {} calls that failed, in {:.0f} s\n"
      "acknowledged and lost              {:8}   limit 0\n"
      "blocks lost to a kill, at most     {:8}   limit 1, the one in hand\n"
      "raw stream lost to a power cut     {:8.3f} s limit 1 s\n"
      "run folders that do not open       {:8}   limit 0\n"
      "resume not offered                 {:8}   limit 0\n"
      "violations, also of these          {:8}   limit 0\n",
      totals.kills, options.lengths.whole, options.lengths.resumed, options.lengths.in_real_time,
      totals.cuts, totals.faults, took_s, totals.lost, totals.blocks_killed, totals.stream_cut_s,
      totals.not_open, totals.not_offered, totals.violations);
  return totals.holds() ? 0 : 1;
}

int run_campaign(Options& options) {
  const auto began = std::chrono::steady_clock::now();
  options.lengths = test::measure_lengths();
  std::vector<std::unique_ptr<test::Program>> workers;
  for (int job = 0; job < options.jobs; ++job) {
    workers.push_back(std::make_unique<test::Program>(std::filesystem::current_path(),
                                                      worker_words(options, job)));
  }
  Totals totals;
  bool failed = false;
  for (const auto& worker : workers) {
    const test::Answer answer = worker->wait();
    std::istringstream lines(answer.out);
    for (std::string line; std::getline(lines, line);) totals.take(line);
    if (answer.code == 0) continue;
    failed = true;
    fmt::print("a worker ended with {}: {}\n", answer.code, answer.err);
  }
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
  const int code = report(options, totals, took.count());
  const bool all = totals.kills == options.kills && totals.cuts == options.cuts &&
                   totals.faults == options.faults;
  return failed || !all ? 1 : code;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (!words.empty() && words.front() == test::writing_process) {
    return test::be_writing_process({words.begin() + 1, words.end()});
  }
  Options options;
  std::vector<long> calls;
  CLI::App app{"Crashes of a run, and what its folder is good for afterwards."};
  app.add_option("--kills", options.kills, "kill -9, at calls all over the run");
  app.add_option("--cuts", options.cuts, "power cuts");
  app.add_option("--faults", options.faults, "full disks and I/O errors");
  app.add_option("--seed", options.seed, "of all that is drawn");
  app.add_option("--jobs", options.jobs, "processes side by side")->check(CLI::Range(1, 64));
  app.add_option("--without", options.without, "what power cuts find missing: journal, syncs")
      ->check(CLI::IsMember(without_named));
  app.add_option("--job", options.job)->group("");
  app.add_option("--calls", calls)->expected(3)->group("");
  CLI11_PARSE(app, argc, argv);
  if (options.job < 0) return run_campaign(options);
  options.lengths = {calls.at(0), calls.at(1), calls.at(2)};
  return work(options);
}
