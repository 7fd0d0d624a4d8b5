#include "bench/acceptance.hpp"

#include <fmt/format.h>

#include <memory>
#include <system_error>
#include <utility>

#include "bench/judging.hpp"
#include "bench/run_log.hpp"
#include "bench/run_recordings.hpp"
#include "bench/run_results.hpp"
#include "hal/recording_file.hpp"
#include "sequences/sequencer.hpp"

namespace rvbench::bench {
namespace {

Ending bench_fault(const IoError& error) {
  return {Outcome::error, ErrorKind::device_lost, describe(error)};
}

hal::RecordingLayout layout_of(const Acceptance& acceptance, const hal::Rig& rig) {
  hal::RecordingLayout layout;
  layout.points = acceptance.plan.points();
  layout.acceleration_channels = rig.accelerometers->channels();
  layout.acceleration_rate_Hz = rig.accelerometers->rate_Hz();
  layout.acceleration_range_m_s2 = rig.accelerometers->range_m_s2();
  layout.torque_rate_Hz = rig.torque_sensor->rate_Hz();
  layout.software = "rvbench " + acceptance.facts.software;
  return layout;
}

// Runs the sequence into a new recording of the folder.
Ending measure(Acceptance& acceptance, hal::Rig& rig, RunLog& log, std::stop_token stop) {
  const Result<RunRecordings> before = RunRecordings::open(acceptance.folder);
  if (!before) return bench_fault(before.error());
  const int first_point = before.value().next_point();
  if (before.value().points() > 0) acceptance.facts.resumed_at_point = first_point;

  auto writer = hal::RecordingWriter::create(acceptance.folder / before.value().next_name(),
                                             layout_of(acceptance, rig));
  if (!writer) return bench_fault(writer.error());
  const sequences::RunSummary summary =
      sequences::run_sequence(acceptance.plan, rig, *writer.value(), log, stop, first_point);
  const Status closed = writer.value()->close();
  acceptance.facts.duration_s = summary.duration_s;
  acceptance.facts.drive_retries = summary.drive_retries;
  acceptance.facts.shaft_stopped = summary.shaft_stopped;
  acceptance.facts.brake_released = summary.brake_released;
  return closed ? summary.ending : graver(summary.ending, bench_fault(closed.error()));
}

JudgedPoint point_without_samples(const hal::PlannedPoint& planned, int number,
                                  std::string status) {
  JudgedPoint point;
  point.status = std::move(status);
  point.planned_speed_rpm = planned.speed_rpm;
  point.examination.source = fmt::format("point {:03}", number);
  point.examination.load_pct = planned.load_pct;
  point.examination.repeat = planned.repeat;
  return point;
}

// Examines every point that was recorded; PASS if none was skipped by a stop.
Ending judge_points(Judgement& judgement, const Acceptance& acceptance, RunRecordings& recordings,
                    const analysis::ExamineOptions& options, ProgressBar& bar,
                    const std::stop_token& stop) {
  const std::vector<hal::PlannedPoint> points = acceptance.plan.points();
  Ending ending{Outcome::pass, ErrorKind::none, "every point was judged"};
  for (int number = 0; number < static_cast<int>(points.size()); ++number) {
    const auto& planned = points[static_cast<std::size_t>(number)];
    bar.show("judge", number / double(points.size()),
             fmt::format("{:.0f} rpm, {:.0f} %, repeat {}", planned.speed_rpm, planned.load_pct,
                         planned.repeat));
    if (!recordings.has(number)) {
      judgement.points.push_back(point_without_samples(planned, number, "not_recorded"));
    } else if (stop.stop_requested()) {
      judgement.points.push_back(point_without_samples(planned, number, "not_judged"));
      ending = {Outcome::aborted, ErrorKind::none, "stopped by the operator while judging"};
    } else if (const Result<Recording> record = recordings.read(number)) {
      judgement.points.push_back(judge_point(record.value(), acceptance.kinematics, options));
    } else {
      judgement.points.push_back(point_without_samples(planned, number, describe(record.error())));
    }
  }
  return ending;
}

}  // namespace

Judgement run_acceptance(Acceptance acceptance, hal::Rig& rig, ProgressBar& bar,
                         std::stop_token stop) {
  RunLog log(acceptance.folder / "log.jsonl", bar);
  const analysis::ExamineOptions options{.clip_level = rig.accelerometers->range_m_s2()};
  Ending ending = measure(acceptance, rig, log, stop);
  Judgement judgement;
  judgement.facts = acceptance.facts;
  Result<RunRecordings> recordings = RunRecordings::open(acceptance.folder);
  RunRecordings recorded;
  if (recordings) {
    recorded = std::move(recordings).value();
  } else {
    ending = graver(ending, bench_fault(recordings.error()));
  }
  ending = graver(ending, judge_points(judgement, acceptance, recorded, options, bar, stop));
  conclude(judgement, acceptance.kinematics, acceptance.plan.limits, ending);
  judgement.facts.events = recorded.events().empty() ? log.events() : recorded.events();
  bar.show("report", 0, "writing");
  try {
    write_results(acceptance.folder, judgement, acceptance.kinematics);
  } catch (const std::system_error& error) {
    const Ending unwritten{Outcome::error, ErrorKind::none,
                           std::string("the results cannot be written: ") + error.what()};
    judgement.ending = graver(judgement.ending, unwritten);
  }
  bar.clear();
  return judgement;
}

}  // namespace rvbench::bench
