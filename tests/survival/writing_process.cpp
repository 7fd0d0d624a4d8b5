#include "tests/survival/writing_process.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

#include "bench/result_database.hpp"
#include "hal/types/outcome.hpp"

namespace rvbench::test {

std::vector<std::string> words_of(const WritingProcess& process) {
  const DiskPlan& disk = process.disk;
  const auto flag = [](bool set) { return std::string(set ? "1" : "0"); };
  return {std::filesystem::read_symlink("/proc/self/exe"),
          writing_process,
          process.runs,
          flag(process.run.resume),
          fmt::format("{}", process.run.pace),
          fmt::format("{}", process.run.recording.flush.count()),
          fmt::format("{}", process.run.recording.sync.count()),
          disk.root,
          disk.record,
          flag(disk.with_calls),
          fmt::format("{}", disk.kill_at),
          flag(disk.kill_halfway),
          fmt::format("{}", disk.fail_at),
          fmt::format("{}", disk.error),
          flag(disk.fail_ever_after)};
}

namespace {

// As the command does. @return why it could not be
std::string enter_result(const std::filesystem::path& runs, const SmallRunEnd& end) {
  auto opened = bench::ResultDatabase::open(runs);
  if (!opened) return describe(opened.error());
  bench::ResultDatabase results = std::move(opened).value();
  const Status entered =
      results.enter(bench::row_of(runs, end.folder, end.judgement), end.judgement);
  if (!entered) return describe(entered.error());
  tell("entered");  // whatever becomes of the others
  const auto caught_up = results.catch_up();
  return caught_up ? "" : describe(caught_up.error());
}

}  // namespace

int be_writing_process(const std::vector<std::string>& words) {
  SmallRunOptions run{
      .resume = words.at(1) == "1", .witnessed = true, .pace = std::stod(words.at(2))};
  run.recording = {std::chrono::milliseconds(std::stol(words.at(3))),
                   std::chrono::milliseconds(std::stol(words.at(4)))};
  watch_disk({.root = words.at(5),
              .record = words.at(6),
              .with_calls = words.at(7) == "1",
              .kill_at = std::stol(words.at(8)),
              .kill_halfway = words.at(9) == "1",
              .fail_at = std::stol(words.at(10)),
              .error = std::stoi(words.at(11)),
              .fail_ever_after = words.at(12) == "1"});
  try {
    if (const auto end = make_small_run(words.at(0), run)) {
      if (end->at_rest) tell("at_rest");
      for (const std::string& file : end->judgement.unwritten) tell("unwritten " + file);
      tell(fmt::format("verdict {} {}", to_string(end->judgement.ending.outcome),
                       end->judgement.ending.reason));
      const std::string not_entered = enter_result(words.at(0), *end);
      if (!not_entered.empty()) tell("not_entered " + not_entered);
    } else {
      tell("refused nothing to resume");
    }
  } catch (const NoRunFolder& error) {
    tell(std::string("refused ") + error.what());
  } catch (const std::exception& error) {
    tell(std::string("threw ") + error.what());
  }
  tell(fmt::format("calls {}", disk_calls()));
  return 0;
}

}  // namespace rvbench::test
