#include "bench/acceptance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <system_error>
#include <utility>

#include "bench/judging.hpp"
#include "bench/run_folder.hpp"
#include "bench/run_log.hpp"
#include "bench/run_recordings.hpp"
#include "bench/run_results.hpp"
#include "bench/sha256.hpp"
#include "bench/software_version.hpp"
#include "bench/text_file.hpp"
#include "bench/twin_check.hpp"
#include "bench/unexamined_point.hpp"
#include "bench/verdict_json.hpp"
#include "hal/service_watchdog.hpp"
#include "hal/steady_clock.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::bench {
namespace {

Ending bench_fault(const IoError& error) {
  return {Outcome::error, ErrorKind::none, describe(error)};
}

Ending fate_of(const RunLog& log) {
  if (log.error() == 0) return {Outcome::pass, ErrorKind::none, "every event was logged"};
  return bench_fault({IoErrc::refused, std::string("log.jsonl: ") + std::strerror(log.error())});
}

// What an earlier part of the run saw of the bench, where this one has nothing to measure: it came
// to rest.
void take_over(const std::filesystem::path& folder, RunFacts& facts) {
  facts.shaft_stopped = facts.brake_released = true;
  const auto earlier = judgement_from_json(read_file(folder / "verdict.json").value_or(""));
  if (!earlier) return;
  facts.duration_s = earlier->facts.duration_s;
  facts.drive_retries = earlier->facts.drive_retries;
}

// Runs the sequence into a new recording of the folder.
Ending record(Acceptance& acceptance, hal::Rig& rig, RunLog& log, std::stop_token stop,
              const RunRecordings& before, int first_point) {
  const std::filesystem::path file = acceptance.folder / before.next_name();
  auto writer = acceptance.begin_recording(file, layout_of(acceptance.plan, rig));
  if (!writer) return bench_fault(writer.error());
  const sequences::RunSummary summary = sequences::run_sequence(
      acceptance.plan, rig, *writer.value(), log, std::move(stop), first_point);
  acceptance.facts.must_exit = summary.supervisor_hung || summary.bus_hung || summary.observer_hung;
  acceptance.facts.log_hung = summary.observer_hung && summary.events_untold > 0;
  const Status closed = writer.value()->close();
  // A later part of a run without a record is no recording to judge; log.jsonl has its events.
  const bool is_first = before.points() == 0;
  std::error_code ignored;  // an empty one does no harm
  if (!is_first && summary.points.empty() && closed) std::filesystem::remove(file, ignored);
  acceptance.facts.duration_s = summary.duration_s;
  acceptance.facts.drive_retries = summary.drive_retries;
  acceptance.facts.shaft_stopped = summary.shaft_stopped;
  acceptance.facts.brake_released = summary.brake_released;
  return closed ? summary.ending : graver(summary.ending, bench_fault(closed.error()));
}

// What was told as measured and is no longer in a recording has been damaged or taken away since.
// Empty: nothing.
std::string told_of_lost_points(const RunLog& log, const RunRecordings& before) {
  std::string lost;
  for (const int point : sequences::points_told(log.events())) {
    if (!before.has(point)) lost += (lost.empty() ? "" : ", ") + std::to_string(point);
  }
  if (lost.empty()) return "";
  return "measured before, but no longer in the run's recordings, which were damaged or taken "
         "away: points " +
         lost;
}

// Goes on after the last point that was measured before. Turns nothing if none is left and the
// bench was seen at rest; if it was not, the last point is measured again: no run passes on a bench
// that failed after it.
Ending measure(Acceptance& acceptance, hal::Rig& rig, RunLog& log, std::stop_token stop) {
  if (log.error() != 0) return fate_of(log);
  if (acceptance.refusal) {
    log.event(0, fmt::format("{}: {}; nothing is turned", to_string(acceptance.refusal->outcome),
                             acceptance.refusal->reason));
    return *acceptance.refusal;
  }
  // Those of an earlier part would vouch for files that are about to change.
  remove_sums(acceptance.folder);
  const Status dropped = drop_empty_recordings(acceptance.folder);
  if (!dropped) return bench_fault(dropped.error());
  const Result<RunRecordings> before = RunRecordings::open(acceptance.folder);
  if (!before) return bench_fault(before.error());
  const auto points = static_cast<int>(acceptance.plan.points().size());
  const int first_point = std::min(before.value().next_point(), points - 1);
  if (before.value().next_point() > first_point && sequences::tell_of_rest(log.events())) {
    take_over(acceptance.folder, acceptance.facts);
    acceptance.facts.resumed_at_point = before.value().resumed_at_point();
    log.event(0, "resumed: every point was measured before, nothing is turned");
    return {Outcome::pass, ErrorKind::none, "everything was measured"};
  }
  // Either may be there alone: a power failure takes the log's last lines.
  if (!log.events().empty() || before.value().points() > 0) {
    acceptance.facts.resumed_at_point = first_point;
    log.event(0, fmt::format("resumed at point {} of {}; the rig's time starts again",
                             first_point + 1, points));
  }
  acceptance.lost_points = told_of_lost_points(log, before.value());
  if (!acceptance.lost_points.empty()) log.event(0, "warning: " + acceptance.lost_points);
  for (const std::string& warning : acceptance.warnings) log.event(0, "warning: " + warning);
  return record(acceptance, rig, log, std::move(stop), before.value(), first_point);
}

const IoError log_that_hangs{IoErrc::refused, "log.jsonl: it takes no more events"};

// What keeps a run from beginning is a fault of the bench, too.
Ending measure_or_fail(Acceptance& acceptance, hal::Rig& rig, RunLog& log, std::stop_token stop) {
  try {
    return measure(acceptance, rig, log, std::move(stop));
  } catch (const std::system_error& error) {
    return bench_fault({IoErrc::refused, reason_of(error)});
  }
}

// For what is told when a thread hangs, perhaps in the screen's call.
struct Nowhere {
  std::ostringstream text;
  Console console{text, text};
  ProgressBar bar{console, ProgressBar::Style::silent};
};

// Examines every point that was recorded; PASS if none was skipped by a stop.
Ending judge_points(Judgement& judgement, const Acceptance& acceptance, RunRecordings& recordings,
                    const analysis::ExamineOptions& options, ProgressBar& bar,
                    const std::stop_token& stop) {
  const std::vector<hal::PlannedPoint> points = acceptance.plan.points();
  Ending ending{Outcome::pass, ErrorKind::none, "every point was judged"};
  const hal::SteadyClock clock;
  hal::ServiceWatchdog service;  // nobody supervises any more, but the service lives
  for (int number = 0; number < static_cast<int>(points.size()); ++number) {
    const auto& planned = points[static_cast<std::size_t>(number)];
    if (!acceptance.facts.must_exit) service.feed(clock.now_s());
    bar.show("judge", number / double(points.size()),
             fmt::format("{:.0f} rpm, {:.0f} %, repeat {}", planned.speed_rpm, planned.load_pct,
                         planned.repeat));
    if (!recordings.has(number)) {
      judgement.points.push_back(unexamined_point(planned, number, not_recorded));
    } else if (stop.stop_requested()) {
      judgement.points.push_back(unexamined_point(planned, number, "not_judged"));
      ending = {Outcome::aborted, ErrorKind::none, "stopped by the operator while judging"};
    } else if (const Result<Recording> record = recordings.read(number)) {
      judgement.points.push_back(judge_point(record.value(), acceptance.kinematics, options));
    } else {
      judgement.points.push_back(unexamined_point(planned, number, describe(record.error())));
    }
  }
  return ending;
}

// Judges what was measured, and writes all that tells of it.
void conclude_run(Judgement& judgement, const Acceptance& acceptance, RunLog& log, ProgressBar& bar,
                  const analysis::ExamineOptions& options, const std::stop_token& stop) {
  Result<RunRecordings> recordings = RunRecordings::open(acceptance.folder);
  RunRecordings recorded;
  Ending ending = judgement.ending;
  if (recordings) {
    recorded = std::move(recordings).value();
  } else {
    ending = graver(ending, bench_fault(recordings.error()));
  }
  const bool log_hung = acceptance.facts.log_hung;
  const Ending judged = judge_points(judgement, acceptance, recorded, options, bar, stop);
  if (judged.outcome == Outcome::aborted && !log_hung) {
    log.event(judgement.facts.duration_s, "ABORTED: " + judged.reason);
  }
  ending = graver(ending, judged);
  if (!acceptance.twin.empty() && ending.outcome == Outcome::pass && !log_hung) {
    bar.show("twin", 0, acceptance.twin);
    log.event(judgement.facts.duration_s, twin_event(acceptance.folder, acceptance.twin));
  }
  ending = graver(ending, log_hung ? bench_fault(log_that_hangs) : fate_of(log));
  conclude(judgement, acceptance.kinematics, acceptance.plan.limits, ending);
  demand_confirmation(judgement, acceptance.kinematics);
  if (!acceptance.lost_points.empty()) {
    judgement.diagnosis.quality.push_back({"recording.h5", acceptance.lost_points, false});
  }
  if (!log_hung) judgement.facts.events = log.events();
  judgement.facts.judged_utc = utc_now();
  bar.show("report", 0, "writing");
  tell_in_files(judgement, [&](const Judgement& told) {
    return write_results(acceptance.folder, told, acceptance.kinematics, acceptance.with_report);
  });
  bar.clear();
}

}  // namespace

hal::RecordingLayout layout_of(const sequences::TestPlan& plan, const hal::Rig& rig) {
  hal::RecordingLayout layout;
  layout.points = plan.points();
  layout.acceleration_channels = rig.accelerometers->channels();
  layout.acceleration_rate_Hz = rig.accelerometers->rate_Hz();
  layout.acceleration_range_m_s2 = rig.accelerometers->range_m_s2();
  layout.torque_rate_Hz = rig.torque_sensor->rate_Hz();
  layout.software = "rvbench " + software_version();
  return layout;
}

Result<std::unique_ptr<hal::RecordingWriter>> make_recording(const std::filesystem::path& file,
                                                             const hal::RecordingLayout& layout) {
  return hal::RecordingWriter::create(file, layout);
}

Judgement run_acceptance(Acceptance acceptance, hal::Rig& rig, ProgressBar& bar,
                         std::stop_token stop) {
  auto log = std::make_unique<RunLog>(acceptance.folder / "log.jsonl", bar);
  Nowhere nowhere;
  Judgement judgement;
  try {
    const analysis::ExamineOptions options{.clip_level = rig.accelerometers->range_m_s2(),
                                           .channels_may_fail = acceptance.plan.channels_may_fail};
    judgement.ending = measure_or_fail(acceptance, rig, *log, stop);
    judgement.facts = acceptance.facts;
    conclude_run(judgement, acceptance, *log, acceptance.facts.must_exit ? nowhere.bar : bar,
                 options, stop);
  } catch (const std::exception& error) {
    if (!acceptance.facts.must_exit) throw;  // else the rig would be destroyed on its way
    judgement.facts = acceptance.facts;
    judgement.ending = graver(
        judgement.ending, bench_fault({IoErrc::refused, std::string("internal: ") + error.what()}));
  }
  if (acceptance.facts.must_exit) (void)log.release();  // whose thread may go on in there
  return judgement;
}

}  // namespace rvbench::bench
