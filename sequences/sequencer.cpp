#include "sequences/sequencer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <utility>

#include "sequences/bench_loop.hpp"
#include "sequences/guarded.hpp"
#include "sequences/plan_on_rig.hpp"
#include "sequences/scribe.hpp"
#include "sequences/standstill.hpp"
#include "sequences/written_behind.hpp"

namespace rvbench::sequences {
namespace {

// Half a minute of 24 channels at 102.4 kHz.
constexpr std::size_t most_bytes_behind = 256UL << 20U;
constexpr std::size_t most_bytes_of_log = 1UL << 20U;  // some two thousand events
constexpr double slow_disk_s = 0.5;
constexpr double most_lag_s = 5;  // what waits would be lost with the process
constexpr double longest_release_s = 1;
constexpr const char* hung =
    "supervisor hung: a device's call does not return, the program must exit";
constexpr const char* bus_hung =
    "a bus does not tell its counters and never returns, the program must exit";
const Ending all_well{Outcome::pass, ErrorKind::none, "everything was measured"};

Ending bench_fault(std::string reason) {
  return {Outcome::error, ErrorKind::none, std::move(reason)};
}

// Of a run that nothing has gone wrong with yet.
RunSummary empty_summary() noexcept {
  return {.ending = {Outcome::pass, ErrorKind::none, {}}, .points = {}};
}

Ending verdict_on(const std::vector<hal::PointResult>& points) {
  const auto bad = std::ranges::count_if(
      points, [](const hal::PointResult& point) { return point.status != "ok"; });
  if (bad == 0) return all_well;
  const auto first =
      std::ranges::find_if(points, [](const auto& point) { return point.status != "ok"; });
  return {Outcome::invalid, ErrorKind::none,
          fmt::format("{} of {} points cannot be used; the first is point {}: {}", bad,
                      points.size(), first->point, first->status)};
}

Ending set_up_and_measure(const TestPlan& plan, BenchLoop& loop) {
  for (const auto* stage : {&plan.setup, &plan.main}) {
    for (const auto& phase : *stage) {
      loop.event(fmt::format("phase {}", phase->kind()));
      if (auto ending = phase->run(loop, plan.specimen)) return *ending;
      // Once connected and not before: of a bench that is not, teardown could not see that the
      // shaft stands still, and would wait for its time-out. Nothing has turned yet.
      if (phase != plan.setup.front()) continue;
      const auto faults = faults_of_plan_on(loop.rig(), plan);
      if (!faults.empty()) return bench_fault(faults.front().message);
    }
  }
  return verdict_on(loop.points());
}

// The brake lets go within a second, or something is wrong with it.
bool brake_lets_go(hal::Rig& rig, Status told) {
  const hal::BrakeLimits brake = rig.brake->limits();
  const double enough_Nm = brake.residual_torque_pct / 100 * brake.max_torque_Nm;
  // A link that is lost may take its time to be opened again, each time.
  const double end_s = rig.clock->now_s() + longest_release_s;
  while (rig.clock->now_s() < end_s) {
    rig.clock->wait_until(rig.clock->now_s() + 0.1);
    const auto status = rig.brake->read();
    // At standstill a brake that was never told may hold nothing, either.
    if (told && status && std::abs(status.value().torque_Nm) <= enough_Nm) return true;
    told = rig.brake->release();
  }
  return false;
}

std::string faults_of_teardown(const RunSummary& summary) {
  std::vector<std::string> faults;
  if (summary.supervisor_hung) faults.emplace_back(hung);
  if (summary.bus_hung) faults.emplace_back(bus_hung);
  if (!summary.shaft_stopped) faults.emplace_back("standstill was not seen");
  if (!summary.brake_released) {
    faults.emplace_back("the brake does not confirm that it has released");
  }
  return fmt::format("{}", fmt::join(faults, ", "));
}

// The supervisor hears meanwhile that its sequencer is there.
void wait_until(BenchLoop& loop, double until_s) {
  while (loop.now_s() < until_s) {
    loop.rig().clock->wait_until(std::min(until_s, loop.now_s() + 1));
    loop.supervisor().hear_sequencer();
  }
}

// Stop, standstill or time-out, release: each step is tried whatever became of the others, with or
// without memory.
Ending tear_down(const TestPlan& plan, BenchLoop& loop, RunSummary& summary) noexcept {
  hal::Rig& rig = loop.rig();
  const double until_s = rig.clock->now_s() + plan.teardown.standstill_timeout_s;
  loop.supervisor().handle(SupervisorEvent::stop);
  loop.devices().stop_drive();
  Ending ending = guarded([&] {
    const RunDown run_down = wait_for_standstill(loop, plan);
    summary.shaft_stopped = run_down.stopped;
    if (run_down.stopped) loop.supervisor().handle(SupervisorEvent::standstill);
    if (run_down.trouble) loop.supervisor().handle(SupervisorEvent::trip);
    return run_down.trouble.value_or(all_well);
  });
  loop.devices().stop_drive();
  ending = graver(std::move(ending), guarded([&] {
                    const bool may_turn = !summary.shaft_stopped && loop.has_turned();
                    if (may_turn) wait_until(loop, until_s);
                    return all_well;
                  }));
  summary.supervisor_hung = !loop.supervisor().end();
  if (!summary.supervisor_hung) {  // the brake is the sequencer's again
    const Status told = rig.brake->release();
    ending = graver(std::move(ending), guarded([&] {
                      summary.brake_released = brake_lets_go(rig, told);
                      return all_well;
                    }));
    rig.accelerometers->stop();
  }
  summary.bus_hung = !loop.end_buses();
  return graver(std::move(ending), guarded([&]() -> Ending {
                  const std::string fault = faults_of_teardown(summary);
                  if (fault.empty()) return all_well;
                  return {Outcome::error, ErrorKind::device_lost, "teardown: " + fault};
                }));
}

std::string state_of(bool shaft_stopped, bool brake_released) {
  return fmt::format("shaft {}, brake {}",
                     shaft_stopped ? "at standstill" : "not seen at standstill",
                     brake_released ? "released" : "not seen released");
}

// What measuring came to. Of a unit it says nothing: its verdict is the judge's, if it comes to
// one.
const char* word_of(Outcome outcome) {
  const bool to_judge = outcome == Outcome::pass || outcome == Outcome::invalid;
  return to_judge ? "measured" : to_string(outcome);
}

// The last lines of the log, for the operator.
void tell(BenchLoop& loop, const RunSummary& summary, const Ending& measured,
          const Ending& torn_down) {
  const bool more = torn_down.outcome != Outcome::pass && torn_down.reason != measured.reason;
  if (more) loop.event("in teardown: " + torn_down.reason);
  loop.event(fmt::format("{}: {}; {}", word_of(summary.ending.outcome), summary.ending.reason,
                         state_of(summary.shaft_stopped, summary.brake_released)));
}

// Samples that wait for the disk are lost with the power: at most a second of them, it is said.
void tell_lag(ObserverBehind& observer, double now_s, double lag_s) {
  if (lag_s <= slow_disk_s) return;
  observer.event(now_s, fmt::format("the disk was up to {:.1f} s behind: a power cut would have "
                                    "cost as much of the record",
                                    lag_s));
}

// How punctual the supervisor was; nothing in virtual time, where nobody is late.
// @pre it does not hang: its thread may come back, and counts on
void tell_lateness(BenchLoop& loop) {
  const Lateness late = loop.supervisor().lateness();
  if (late.rounds() == 0) return;
  loop.event(fmt::format("supervisor: {} rounds, 99 % at most {:.3f} ms late, the latest {:.1f} ms",
                         late.rounds(), 1e3 * late.quantile_s(0.99), 1e3 * late.longest_s()));
}

// All of a run but what guards it.
void run(const TestPlan& plan, BenchLoop& loop, RunSummary& summary) {
  const double start_s = loop.now_s();
  Ending measured = guarded([&] { return set_up_and_measure(plan, loop); });
  Ending torn_down = tear_down(plan, loop, summary);
  // What ended the run counts, also where telling it threw.
  measured = graver(std::move(measured), guarded([&] { return loop.ended().value_or(all_well); }));
  torn_down = graver(std::move(torn_down), guarded([&] {
                       loop.interrupt_record();
                       return all_well;
                     }));
  summary.ending = graver(measured, torn_down);
  if (summary.supervisor_hung && summary.ending.reason != torn_down.reason) {
    summary.ending.reason += std::string("; ") + hung;
  }
  summary.points = loop.points();
  summary.drive_retries = loop.rig().drive->retries();
  summary.duration_s = loop.now_s() - start_s;
  if (!summary.supervisor_hung) tell_lateness(loop);
  tell(loop, summary, measured, torn_down);
}

// What the run comes to where nothing but the rig makes anybody wait.
RunSummary run_unhindered(const TestPlan& plan, hal::Rig& rig, hal::RecordingWriter& recording,
                          RunObserver& observer, std::stop_token stop, int first_point) {
  RunSummary summary = empty_summary();
  bool drive_hangs = false;
  Ending unforeseen = guarded([&] {
    auto loop =
        std::make_unique<BenchLoop>(plan, rig, recording, observer, std::move(stop), first_point);
    Ending ending = guarded([&] {
      run(plan, *loop, summary);
      return all_well;
    });
    summary.supervisor_hung = !loop->supervisor().end();
    drive_hangs = summary.supervisor_hung && loop->supervisor().is_stopping_drive();
    summary.bus_hung = !loop->end_buses();
    if (summary.supervisor_hung) (void)loop.release();  // its thread goes on in there
    return ending;
  });
  if (unforeseen.outcome != Outcome::pass) {
    // Nobody knows how far the run has come: these are legal in every state.
    if (!drive_hangs) rig.drive->stop();
    if (!summary.supervisor_hung) {
      (void)rig.brake->release();
      rig.accelerometers->stop();
    }
  }
  summary.ending = graver(std::move(summary.ending), std::move(unforeseen));
  return summary;
}

}  // namespace

bool tell_of_rest(const std::vector<std::pair<double, std::string>>& events) {
  for (auto event = events.rbegin(); event != events.rend(); ++event) {
    const std::string& text = event->second;
    if (text == armed_event) return false;  // and what became of it is not told
    if (text.ends_with(state_of(true, true))) return !text.starts_with(to_string(Outcome::error));
  }
  return false;
}

std::set<int> points_told(const std::vector<std::pair<double, std::string>>& events) {
  const std::string begin(point_event, std::string_view(point_event).find('{'));
  std::set<int> points;
  for (const auto& [time_s, text] : events) {
    if (!text.starts_with(begin)) continue;
    int point = 0;
    const char* const number = text.data() + begin.size();
    const auto [end, error] = std::from_chars(number, text.data() + text.size(), point);
    if (error == std::errc() && *end == ':') points.insert(point);
  }
  return points;
}

RunSummary run_sequence(const TestPlan& plan, hal::Rig& rig, hal::RecordingWriter& recording,
                        RunObserver& observer, std::stop_token stop, int first_point) {
  // Virtual time stands still while somebody writes.
  if (rig.clock->is_virtual()) {
    return run_unhindered(plan, rig, recording, observer, std::move(stop), first_point);
  }
  RunSummary summary = empty_summary();
  Ending written = guarded([&]() -> Ending {
    Scribe disk(most_bytes_behind, most_lag_s);
    Scribe log(most_bytes_of_log);
    Scribe screen(most_bytes_of_log);
    RecordingBehind recording_behind(recording, disk);
    ObserverBehind observer_behind(observer, log, screen);
    summary =
        run_unhindered(plan, rig, recording_behind, observer_behind, std::move(stop), first_point);
    Ending ending = guarded([&] {
      const Status settled = recording_behind.settle();
      tell_lag(observer_behind, rig.clock->now_s(), disk.longest_lag_s());
      if (settled) return all_well;
      Ending unwritten =
          bench_fault("the recording cannot be written: " + describe(settled.error()));
      // The log's last line was another.
      observer_behind.event(rig.clock->now_s(), "ERROR: " + unwritten.reason);
      return unwritten;
    });
    summary.observer_hung = !observer_behind.finish();
    summary.events_untold = observer_behind.untold();
    if (summary.events_untold == 0) return ending;
    return graver(std::move(ending), guarded([&] {
                    return bench_fault(fmt::format("the log lacks {} events: it was too far behind",
                                                   summary.events_untold));
                  }));
  });
  summary.ending = graver(std::move(summary.ending), std::move(written));
  return summary;
}

}  // namespace rvbench::sequences
