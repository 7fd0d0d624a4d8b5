#include "tests/survival/aftermath.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_recordings.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/survival/small_run.hpp"

namespace rvbench::test {
namespace {

// Whether the log's whole lines end with a bench at rest, since it was armed last.
bool tells_of_rest(const std::string& log) {
  std::istringstream lines(log);
  bool is_told = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.ends_with('}')) continue;  // torn
    if (line.find("\"armed") != std::string::npos) is_told = false;
    if (line.find("; shaft at standstill, brake released") == std::string::npos) continue;
    is_told = line.find("\"ERROR") == std::string::npos;
  }
  return is_told;
}

class Examiner {
 public:
  Examiner(const std::filesystem::path& root, const Witness& witness, std::int64_t end_ns)
      : root_(root), witness_(witness), end_ns_(end_ns) {}

  Aftermath examine() {
    try {
      look();
    } catch (const std::exception& error) {
      blame(std::string("threw: ") + error.what());
    }
    return std::move(found_);
  }

 private:
  void look() {
    const std::filesystem::path folder = newest_folder();
    if (folder.empty()) {
      if (witness_.made) lose("the run folder is gone");
      return;
    }
    if (witness_.verdict) check_verdict(folder, *witness_.verdict);
    if (witness_.entered) check_entered();
    if (bench::is_finished(folder)) {
      check_finished(folder);
      return check_table(folder);
    }
    if (bench::newest_unfinished_run(root_, small_run_serial) != folder) {
      if (!witness_.made) return;
      found_.resume_offered = false;
      return blame("resume is not offered");
    }
    int next_point = check_recordings(folder);
    // On a bench that was not seen at rest after the last point that one is measured again.
    const std::string log = bench::read_file(folder / "log.jsonl").value_or("");
    if (next_point == small_run_points && !tells_of_rest(log)) {
      measured_again_ = --next_point;
    }
    if (!found_.opens) return;
    check_resumed(next_point);
    check_table(folder);
  }

  void blame(const std::string& what) { found_.violations.push_back(what); }
  void lose(const std::string& what) {
    ++found_.acknowledged_lost;
    blame(what);
  }

  std::filesystem::path newest_folder() const {
    std::filesystem::path newest;
    std::error_code absent;
    const auto parent = root_ / bench::folder_name_of(small_run_serial);
    for (const auto& entry : std::filesystem::directory_iterator(parent, absent)) {
      newest = std::max(newest, entry.path());
    }
    return newest;
  }

  // Whatever was told of the run's end is in the file, if the file could be written.
  void check_verdict(const std::filesystem::path& folder, const std::string& told) {
    const bool is_unwritten = std::ranges::any_of(witness_.unwritten, [](const std::string& file) {
      return file.starts_with("verdict.json");
    });
    if (is_unwritten) return;
    const auto kept =
        bench::judgement_from_json(bench::read_file(folder / "verdict.json").value_or(""));
    if (!kept) return lose("the verdict is gone: " + told);
    const std::string text =
        fmt::format("{} {}", to_string(kept->ending.outcome), kept->ending.reason);
    if (text != told) lose("the verdict was " + told + ", the file says " + text);
  }

  // An entry that was made is there as it was made.
  void check_entered() {
    for (const bench::RunRow& row : rows(false)) {
      if (row.verdict + " " + row.reason == witness_.verdict.value_or("")) return;
    }
    lose("the table of results lacks " + witness_.verdict.value_or(""));
  }

  // One that was not is made up for, out of the folders.
  void check_table(const std::filesystem::path& folder) {
    for (const bench::RunRow& row : rows(true)) {
      if (root_ / row.folder == folder && row.verdict == "PASS") return;
    }
    blame("the table of results does not catch up with the folder");
  }

  std::vector<bench::RunRow> rows(bool is_to_catch_up) {
    auto opened = bench::ResultDatabase::open(root_);
    if (!opened) {
      blame(describe(opened.error()));
      return {};
    }
    bench::ResultDatabase results = std::move(opened).value();
    if (is_to_catch_up) {
      if (const auto done = results.catch_up(); !done) blame(describe(done.error()));
    }
    auto all = results.runs();
    if (!all) blame(describe(all.error()));
    return all ? std::move(all).value() : std::vector<bench::RunRow>();
  }

  void check_finished(const std::filesystem::path& folder) {
    for (const std::string& fault : bench::verify_sums(folder)) blame("finished, but " + fault);
    const auto text = bench::read_file(folder / "verdict.json");
    const auto judgement = bench::judgement_from_json(text.value_or(""));
    if (!judgement || judgement->ending.outcome != Outcome::pass) blame("finished, but not PASS");
    auto recordings = bench::RunRecordings::open(folder);
    if (!recordings) return does_not_open(recordings.error());
    bench::RunRecordings run = std::move(recordings).value();
    check_ended(run);
  }

  void does_not_open(const IoError& error) {
    found_.opens = false;
    blame("does not open: " + describe(error));
  }

  // @return the next point that is to be measured
  int check_recordings(const std::filesystem::path& folder) {
    auto opened = bench::RunRecordings::open(folder);
    if (!opened) {
      does_not_open(opened.error());
      return 0;
    }
    bench::RunRecordings recordings = std::move(opened).value();
    check_ended(recordings);
    check_stream(folder);
    return recordings.next_point();
  }

  void check_ended(bench::RunRecordings& recordings) {
    for (const auto& [point, ended] : witness_.ended) {
      if (point == measured_again_) continue;
      if (!recordings.has(point)) {
        lose(fmt::format("point {} is gone", point));
        continue;
      }
      const Result<Recording> record = recordings.read(point);
      if (!record) {
        lose(fmt::format("point {}: {}", point, describe(record.error())));
      } else if (record.value().status != ended.status ||
                 accelerations_in(record.value()) != ended.accelerations ||
                 torques_in(record.value()) != ended.torques) {
        lose(fmt::format("point {} is not what was handed over", point));
      }
    }
  }

  // The recording that was being written: blocks up to some moment, and then none.
  void check_stream(const std::filesystem::path& folder) {
    if (witness_.handed.empty()) return;
    const auto reader = hal::RecordingReader::open(folder / witness_.recording);
    if (!reader) return does_not_open(reader.error());
    for (int point = 0; point < small_run_points; ++point) {
      const Result<Recording> record = reader.value()->read(point);
      if (!record) return does_not_open(record.error());
      check_blocks(point, false, accelerations_in(record.value()));
      check_blocks(point, true, torques_in(record.value()));
    }
  }

  void check_blocks(int point, bool is_torque, const SampleSum& kept) {
    kept_any_ = kept_any_ || kept.count > 0;
    bool is_border = kept == SampleSum{};
    for (std::size_t i = 0; i < witness_.handed.size(); ++i) {
      const Handed& block = witness_.handed[i];
      if (block.point != point || block.is_torque != is_torque) continue;
      is_border = is_border || block.sum == kept;
      if (block.sum.count <= kept.count) continue;
      found_.blocks_lost = std::max(found_.blocks_lost, int(witness_.handed.size() - i));
      const double lost_s = static_cast<double>(end_ns_ - block.time_ns) / 1e9;
      found_.stream_lost_s = std::max(found_.stream_lost_s, lost_s);
    }
    if (is_border) return;
    blame(fmt::format("point {}: {} {} are not what was handed over", point, kept.count,
                      is_torque ? "torques" : "scans"));
  }

  void check_resumed(int next_point) {
    const bool began = next_point > 0 || kept_any_;
    const auto end = make_small_run(root_, {.resume = true});
    if (!end) {
      found_.resume_offered = false;
      return blame("resume is refused");
    }
    const bench::Judgement& judgement = end->judgement;
    if (judgement.ending.outcome != Outcome::pass) {
      blame("resumed, it ends " + std::string(to_string(judgement.ending.outcome)) + ": " +
            judgement.ending.reason);
    }
    if (!end->at_rest) blame("the shaft turns after the resumed run");
    check_told(*end, next_point, began);
    for (const std::string& fault : bench::verify_sums(end->folder)) blame("resumed: " + fault);
    auto recordings = bench::RunRecordings::open(end->folder);
    if (!recordings) return does_not_open(recordings.error());
    bench::RunRecordings run = std::move(recordings).value();
    for (int point = 0; point < small_run_points; ++point) {
      if (!run.has(point)) blame(fmt::format("resumed: point {} is missing", point));
    }
    check_ended(run);
  }

  // A run that goes on says where, in the report as well.
  void check_told(const SmallRunEnd& end, int next_point, bool began) {
    const bool goes_on = next_point < small_run_points;
    if (!began) return;
    if (goes_on && end.judgement.facts.resumed_at_point != next_point) {
      blame(fmt::format("it does not say that it was resumed at point {}", next_point));
    }
    const std::string report = bench::read_file(end.folder / "report.html").value_or("");
    const std::string words =
        goes_on ? fmt::format("resumed at point {} after a new warm-up", next_point + 1)
                : "every point was measured before";
    if (report.find(words) == std::string::npos) blame("its report does not say: " + words);
  }

  const std::filesystem::path& root_;
  const Witness& witness_;
  std::int64_t end_ns_;
  bool kept_any_ = false;    // samples of the recording that was being written
  int measured_again_ = -1;  // the point that the resumed run replaced
  Aftermath found_;
};

}  // namespace

Aftermath examine_aftermath(const std::filesystem::path& root, const Witness& witness,
                            std::int64_t end_ns) {
  return Examiner(root, witness, end_ns).examine();
}

}  // namespace rvbench::test
