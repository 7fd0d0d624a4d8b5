#include "tests/survival/crashes.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>

#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "tests/support/program.hpp"
#include "tests/survival/power_cut.hpp"
#include "tests/survival/writing_process.hpp"

namespace rvbench::test {
namespace {

constexpr double recorded_pace = 2;
constexpr double killed_pace = 4;
constexpr int real_time_every = 7;  // shares no factor with the other choices by number

// A disk of its own, with what was heard of the processes that wrote to it.
class Disk {
 public:
  explicit Disk(const std::filesystem::path& scratch) : scratch_(scratch) {
    std::filesystem::create_directory(root());
  }

  std::filesystem::path root() const { return scratch_ / "disk"; }
  std::filesystem::path runs() const { return root() / "runs"; }

  /// @return the entries of its record
  std::vector<DiskEntry> run(WritingProcess process) {
    process.disk.root = root();
    process.disk.record = scratch_ / fmt::format("record-{}", ++processes_);
    process.runs = runs();
    const Answer answer = Program(scratch_, words_of(process)).wait();
    was_killed_ = answer.code == -SIGKILL;
    if (!was_killed_ && answer.code != 0) {
      throw std::runtime_error(fmt::format("survival: exit {}: {}", answer.code, answer.err));
    }
    std::vector<DiskEntry> entries = read_entries(process.disk.record);
    witness_ = heard(witness_, entries);
    return entries;
  }

  bool was_killed() const { return was_killed_; }  ///< the last process
  const Witness& witness() const { return witness_; }
  bool offers_resume() const {
    return bench::newest_unfinished_run(runs(), small_run_serial).has_value();
  }

 private:
  std::filesystem::path scratch_;
  int processes_ = 0;
  bool was_killed_ = false;
  Witness witness_;
};

// Small intervals: many states of the disk within a run that takes no time.
WritingProcess quick(bool resume) {
  WritingProcess process;
  process.run.resume = resume;
  process.run.recording = {std::chrono::milliseconds(2), std::chrono::milliseconds(3)};
  return process;
}

WritingProcess struck_in_real_time() {
  WritingProcess process;
  process.run.pace = killed_pace;
  return process;
}

long call_at(double share, long calls) {
  return std::clamp(std::lround(share * static_cast<double>(calls)), 1L, calls);
}

// @return the entries of its record, with its calls if asked for
std::vector<DiskEntry> kill_somewhere(Disk& disk, long call, bool with_calls = false) {
  WritingProcess first = quick(false);
  first.disk.kill_at = call;
  first.disk.with_calls = with_calls;
  return disk.run(first);
}

// What a later process did to the same disk: entries that refer to others do so by their numbers.
void append(std::vector<DiskEntry>& all, std::vector<DiskEntry> later) {
  const auto before = static_cast<int>(all.size());
  for (DiskEntry& entry : later) {
    entry.object += entry.object < 0 ? 0 : before;
    entry.began += before;
    all.push_back(std::move(entry));
  }
}

// Puts `strike` upon a run, or upon its resumed half; earlier where it came too late.
// @param struck  whether it came
template <typename Struck>
Crash strike_run(const RunLengths& lengths, double share, int number, WritingProcess strike,
                 long DiskPlan::*at, Struck&& struck) {
  std::mt19937_64 random(static_cast<std::uint64_t>(number));
  const bool is_in_real_time = strike.run.pace > 0;
  const bool resume = !is_in_real_time && number % 3 == 2;
  const long calls = is_in_real_time ? lengths.in_real_time
                     : resume        ? lengths.resumed
                                     : lengths.whole;
  for (double part = share;; part *= 0.9) {
    const ScratchFolder scratch;
    Disk disk(scratch.path());
    if (resume) {
      const double first = std::uniform_real_distribution<double>(0.1, 0.95)(random);
      kill_somewhere(disk, call_at(first, lengths.whole));
      if (!disk.was_killed() || !disk.offers_resume()) continue;
    }
    strike.run.resume = resume;
    strike.disk.*at = call_at(part, calls);
    disk.run(strike);
    if (!struck(disk)) continue;
    const Witness& witness = disk.witness();
    return {fmt::format("call {} of a {} run{}, case {}", strike.disk.*at,
                        resume ? "resumed" : "new", is_in_real_time ? " in real time" : "", number),
            examine_aftermath(disk.runs(), witness, disk.was_killed() ? witness.killed_ns : 0)};
  }
}

// The run must have ended as an ERROR that names the place, with the shaft at rest.
void check_ending(const Witness& witness, const DiskPlan& plan, Aftermath& found) {
  const std::string told = witness.verdict.value_or("ERROR " + witness.refusal + witness.thrown);
  const auto blame = [&](const std::string& what) { found.violations.push_back(what + told); };
  if (witness.struck_at_end) {  // the folder is the result: the entry is made up for later
    if (!told.starts_with("PASS")) blame("only its entry failed, and it ends ");
    if (!witness.entered && witness.not_entered.empty()) blame("no word of its entry: ");
    return;
  }
  if (!witness.thrown.empty()) blame("a call failed, and " + witness.thrown + " was thrown, not ");
  if (!told.starts_with("ERROR")) blame("a call failed, and it ends ");
  if (told.find(std::strerror(plan.error)) == std::string::npos) {
    blame(fmt::format("it does not say \"{}\": ", std::strerror(plan.error)));
  }
  std::filesystem::path place = std::filesystem::path(witness.struck).filename();
  if (place.extension() == ".journal") place.replace_extension();
  if (const auto of = bench::drafted_file(place); !of.empty()) place = of;
  // Of a folder that is synced the file is named for whose sake; later failures have other names.
  const bool is_named = !place.has_extension() || plan.fail_ever_after ||
                        told.find(place.string()) != std::string::npos;
  if (!is_named) blame("it does not name " + place.string() + ": ");
  if (witness.verdict && !witness.at_rest) blame("the shaft is not at rest: ");
}

void remove_journals(const std::filesystem::path& root) {
  std::vector<std::filesystem::path> journals;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.path().extension() == ".journal") journals.push_back(entry.path());
  }
  for (const auto& journal : journals) std::filesystem::remove(journal);
}

}  // namespace

RunLengths measure_lengths() {
  const ScratchFolder first, second, third;
  Disk whole(first.path());
  whole.run(quick(false));
  Disk half(second.path());
  kill_somewhere(half, whole.witness().calls / 2);
  half.run(quick(true));
  Disk real(third.path());
  real.run(struck_in_real_time());
  return {whole.witness().calls, half.witness().calls, real.witness().calls};
}

Crash kill_run(const RunLengths& lengths, double share, int number) {
  WritingProcess strike = number % real_time_every == 0 ? struck_in_real_time() : quick(false);
  strike.disk.kill_halfway = number % 2 == 1;
  Crash crash = strike_run(lengths, share, number, strike, &DiskPlan::kill_at,
                           [](const Disk& disk) { return disk.was_killed(); });
  crash.what = "killed at " + crash.what;
  if (crash.aftermath.blocks_lost > 1) {
    crash.aftermath.violations.push_back(
        fmt::format("{} blocks are lost, not only the one in hand", crash.aftermath.blocks_lost));
  }
  return crash;
}

Crash fail_run(const RunLengths& lengths, double share, int number) {
  WritingProcess strike = quick(false);
  strike.disk.error = number % 2 == 0 ? ENOSPC : EIO;
  strike.disk.fail_ever_after = number / 2 % 2 == 0;
  Witness witness;
  Crash crash =
      strike_run(lengths, share, number, strike, &DiskPlan::fail_at, [&witness](const Disk& disk) {
        witness = disk.witness();
        return !witness.struck.empty();
      });
  check_ending(witness, strike.disk, crash.aftermath);
  crash.what = fmt::format("{}{} at {}", std::strerror(strike.disk.error),
                           strike.disk.fail_ever_after ? " for ever" : "", crash.what);
  return crash;
}

RecordedRun::RecordedRun(const RunLengths& lengths, bool resume) : resume_(resume) {
  Disk disk(scratch_.path());
  if (resume) entries_ = kill_somewhere(disk, lengths.whole / 2, true);
  begin_ = entries_.size();
  WritingProcess process;
  process.run.resume = resume;
  process.run.pace = recorded_pace;
  process.disk.with_calls = true;
  append(entries_, disk.run(process));
}

Crash RecordedRun::cut(std::uint64_t seed, Without without) const {
  std::mt19937_64 random(seed);
  std::size_t moment = begin_ + 1 + random() % (entries_.size() - 1 - begin_);
  std::int64_t end_ns = entries_[moment].time_ns;
  if (random() % 2 == 0) {  // by time, not by number
    const std::int64_t begin_ns = entries_[begin_].time_ns;
    end_ns =
        begin_ns + static_cast<std::int64_t>(
                       random() % static_cast<std::uint64_t>(entries_.back().time_ns - begin_ns));
    const auto next = std::ranges::upper_bound(entries_, end_ns, {}, &DiskEntry::time_ns);
    moment = static_cast<std::size_t>(next - entries_.begin());
  }
  const std::vector<DiskEntry> told(entries_.begin(), entries_.begin() + std::ptrdiff_t(moment));
  const ScratchFolder after;
  const PowerCut cut(scratch_ / "disk", entries_, without != Without::syncs);
  cut.make(after.path(), moment, seed);
  if (without == Without::journal) remove_journals(after.path());
  return {fmt::format("power cut before entry {} of a {} run, seed {}", moment,
                      resume_ ? "resumed" : "new", seed),
          examine_aftermath(after / "runs", heard({}, told), end_ns)};
}

}  // namespace rvbench::test
