#include "bench/rejudging.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "bench/judging.hpp"
#include "bench/run_recordings.hpp"
#include "bench/software_version.hpp"
#include "bench/unexamined_point.hpp"
#include "hal/recording_file.hpp"

namespace rvbench::bench {
namespace {

const Ending measured{Outcome::pass, ErrorKind::none, "every point was judged"};

// Full scale of the sensors, as the recording states it.
double range_of(const std::filesystem::path& folder) {
  const auto reader = hal::RecordingReader::open(folder / "recording.h5");
  return reader ? reader.value()->layout().acceleration_range_m_s2 : not_known;
}

// Then the diagnosis, which knows of no other limits, is the same by both.
bool bound_depths_alike(const analysis::Kinematics& kinematics,
                        const std::vector<sequences::Limit>& a,
                        const std::vector<sequences::Limit>& b) {
  const auto limits = [](const analysis::Signature& part) {
    return std::tuple(part.depth_limit, part.noise_limit, part.aligned_limit, part.scatter_limit);
  };
  return std::ranges::equal(with_limits(kinematics, a).signatures,
                            with_limits(kinematics, b).signatures, {}, limits, limits);
}

Ending judge_recordings(Judgement& judgement, const StoredRun& run,
                        const analysis::Kinematics& kinematics,
                        const std::function<void(double)>& progress) {
  auto opened = RunRecordings::open(run.folder);
  RunRecordings recordings;
  Ending ending = measured;
  if (opened) {
    recordings = std::move(opened).value();
  } else {
    ending = {Outcome::error, ErrorKind::none, describe(opened.error())};
  }
  const analysis::ExamineOptions options{.clip_level = range_of(run.folder),
                                         .channels_may_fail = run.plan.channels_may_fail};
  const std::vector<hal::PlannedPoint> points = run.plan.points();
  for (int number = 0; number < static_cast<int>(points.size()); ++number) {
    const hal::PlannedPoint& planned = points[std::size_t(number)];
    progress(number / double(points.size()));
    if (!recordings.has(number)) {
      judgement.points.push_back(unexamined_point(planned, number, not_recorded));
    } else if (const Result<Recording> record = recordings.read(number)) {
      judgement.points.push_back(judge_point(record.value(), kinematics, options));
    } else {
      judgement.points.push_back(unexamined_point(planned, number, describe(record.error())));
    }
  }
  return ending;
}

}  // namespace

std::string why_not_judged_again(const StoredRun& run) {
  const Ending& ending = run.as_judged.ending;
  if (ending.outcome != Outcome::error && ending.outcome != Outcome::aborted) return "";
  return std::string("ended ") + to_string(ending.outcome) + " (" + ending.reason +
         "): no limit decides on it; measure the unit again";
}

Judgement judged_again(const StoredRun& run, const std::vector<sequences::Limit>& limits,
                       const std::function<void(double)>& progress) {
  const analysis::Kinematics kinematics = with_limits(run.kinematics, limits);
  Judgement judgement;
  judgement.facts = run.as_judged.facts;
  judgement.facts.software = software_version();
  const Ending ending = judge_recordings(judgement, run, kinematics, progress);
  conclude(judgement, kinematics, limits, ending);
  demand_confirmation(judgement, kinematics);
  return judgement;
}

Judgement judged_by_limits(const StoredRun& run, const std::vector<sequences::Limit>& limits) {
  const analysis::Kinematics kinematics = with_limits(run.kinematics, limits);
  Judgement judgement;
  judgement.facts = run.as_judged.facts;
  judgement.points = run.as_judged.points;
  conclude(judgement, kinematics, limits, measured);
  demand_confirmation(judgement, kinematics);
  return judgement;
}

EndingsByLimits endings_by_limits(const StoredRun& run,
                                  const std::vector<sequences::Limit>& others) {
  Judgement judgement = judged_by_limits(run, run.plan.limits);
  EndingsByLimits endings{judgement.ending, {}};
  if (bound_depths_alike(run.kinematics, run.plan.limits, others)) {
    hold_against(judgement, others, measured);
  } else {
    judgement = judged_by_limits(run, others);
  }
  endings.by_others = judgement.ending;
  return endings;
}

}  // namespace rvbench::bench
