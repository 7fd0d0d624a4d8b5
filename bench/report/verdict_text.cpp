#include "bench/report/verdict_text.hpp"

#include <fmt/format.h>

#include "bench/findings_stand.hpp"
#include "bench/results/run_filter.hpp"

namespace rvbench::bench::report {
namespace {

const char* meaning_of_invalid(const Judgement& judgement) {
  switch (lack_of(judgement)) {
    case Lack::limit_measured:
      return "A limit could not be held against the data, so the unit is neither passed nor "
             "failed. What was found in the data stands. Record what the limit needs, or take it "
             "out of the plan.";
    case Lack::part_shown:
      return "Of one part the data do not tell whether it is good, so the unit is neither passed "
             "nor failed. What was found of others stands. Measure longer, or at more points.";
    case Lack::sound_data: break;
  }
  return "The data cannot be trusted: nothing is said about the unit. Measure again.";
}

}  // namespace

const char* meaning_of(const Judgement& judgement) {
  const Ending& ending = judgement.ending;
  switch (ending.outcome) {
    case Outcome::pass: return "The unit is good.";
    case Outcome::fail: return "The unit is bad.";
    case Outcome::invalid: return meaning_of_invalid(judgement);
    case Outcome::aborted:
      return "The run was stopped before its end: nothing is said about the unit.";
    case Outcome::error: break;
  }
  if (ending.error_kind == ErrorKind::safety_trip) {
    return "An interlock stopped the bench: nothing is said about the unit. Find the cause first.";
  }
  return "The bench, not the unit, is at fault: nothing is said about the unit.";
}

std::string readable_time(const std::string& utc) {
  const std::string readable = readable_utc(utc);
  return readable == utc ? utc : readable + " UTC";
}

std::string points_text(const Judgement& judgement) {
  std::size_t recorded = 0;
  for (const JudgedPoint& point : judgement.points)
    recorded += point.status != not_recorded ? 1 : 0;
  return fmt::format("{} of {} recorded", recorded, judgement.points.size());
}

}  // namespace rvbench::bench::report
