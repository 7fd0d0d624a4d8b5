#include "bench/tpa_reducer.hpp"

#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/recordings_to_judge.hpp"
#include "bench/run_folder.hpp"
#include "bench/software_version.hpp"
#include "bench/stop_on_signal.hpp"

namespace rvbench::bench {
namespace {

std::variant<Judgement, std::string> judged(const std::string& file,
                                            const analysis::Kinematics& kinematics,
                                            const std::stop_token& stop) {
  auto read = recordings_to_judge({.files = {file}, .hints = {}, .channel = "", .stop = stop});
  if (const auto* refusal = std::get_if<JudgeRefusal>(&read)) return refusal->reason;
  Judgement judgement;
  judgement.facts.software = software_version();
  judgement.facts.started_utc = utc_now();
  for (const Recording& record : std::get<0>(read)) {
    end_if_stopped(stop);
    judgement.points.push_back(judge_point(record, kinematics, {}));
  }
  conclude(judgement, kinematics, {}, {Outcome::pass, ErrorKind::none, "every recording was read"});
  demand_confirmation(judgement, kinematics);
  return judgement;
}

}  // namespace

std::variant<ReducerAnswer, std::string> judge_reducer(const TpaReducer& reducer,
                                                       const std::stop_token& stop) {
  auto machine = read_kinematics(reducer.kinematics);
  if (machine.index() == 1) {
    return hal::describe(reducer.kinematics, std::get<1>(machine).front());
  }
  ReducerAnswer answer{reducer, std::get<0>(std::move(machine)), {}, {}};
  auto before = judged(reducer.recording, answer.kinematics, stop);
  if (const auto* why = std::get_if<std::string>(&before)) return *why;
  answer.judgement = std::get<0>(std::move(before));
  if (reducer.after.empty()) return answer;
  auto after = judged(reducer.after, answer.kinematics, stop);
  if (const auto* why = std::get_if<std::string>(&after)) return *why;
  answer.after = std::get<0>(std::move(after));
  return answer;
}

}  // namespace rvbench::bench
