#include "tests/faults/oracle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rvbench::test {
namespace {

// The angle tells 5 rpm from a window of 0.05 s, standstill must last 0.1 s, the drive is asked
// every 0.05 s; and one tick of the control.
constexpr double release_limit_s = 0.2 + 0.01;

bool is_answered(Answer asked, const Ending& ending) {
  switch (asked) {
    case Answer::pass: return ending.outcome == Outcome::pass;
    case Answer::no_pass: return ending.outcome != Outcome::pass;
    case Answer::device_lost: return ending.error_kind == ErrorKind::device_lost;
    case Answer::safety_trip: return ending.error_kind == ErrorKind::safety_trip;
    case Answer::aborted: return ending.outcome == Outcome::aborted;
  }
  return false;
}

// A trip left from before is reset at connect, a hiccup there may refuse the connection, and in
// virtual time a temperature may never have been known.
bool matters_at_connect(const FaultKind& kind) {
  constexpr std::array forgiven{"drive trips", "brake trips", "spike", "controller stalls",
                                "temperature sensor lost"};
  return kind.answer != Answer::pass && std::ranges::find(forgiven, kind.name) == forgiven.end();
}

}  // namespace

void Oracle::after_return() {
  const bool is_cut_off = fault_.kind != nullptr && fault_.kind->cuts_brake_off;
  if (bench_.was(BenchState::warming_up) && bench_.brake_Nm() > 0 && !is_cut_off) {
    blame("the brake still holds when the run has ended");
  }
  if (bench_.is_driven()) blame("the shaft is driven when the run has ended");
}

void Oracle::long_after() {
  if (std::abs(bench_.speed_rpm()) > 1) blame("the shaft turns for ever");
  if (bench_.is_driven()) blame("the shaft is driven after the end");
  if (bench_.brake_Nm() > 0) blame("the brake holds for ever");
}

void Oracle::on_shaft_and_brake(double struck_s, bool was_driven, double stop_asked_s,
                                double standstill_timeout_s) {
  if (was_driven) stopped(shown_s(struck_s, stop_asked_s));
  if (bench_.braked_until_s() == 0 || bench_.driven_until_s() == 0) return;
  released(standstill_timeout_s);
  not_released_early(stop_asked_s, standstill_timeout_s);
}

// Moments that never came are NaN.
double Oracle::shown_s(double struck_s, double stop_asked_s) const {
  const double settling_s = bench_.entered_s(BenchState::settling);
  const double again_s = bench_.entered_s(BenchState::settling_again);
  const double next_s = settling_s > struck_s ? settling_s : again_s;
  switch (fault_.kind->shown) {
    case Shown::at_once: break;
    case Shown::at_stop: return std::fmax(struck_s, stop_asked_s);
    case Shown::at_next_speed:
      return std::fmax(struck_s, next_s > struck_s ? next_s : stop_asked_s);
    case Shown::in_next_record: {
      if (fault_.state > BenchState::settling_again || fault_.state == BenchState::recording) break;
      const bool is_second = fault_.state == BenchState::settling_again;
      return std::fmax(struck_s, (is_second ? again_s : settling_s) + FaultBench::record_after_s);
    }
  }
  return struck_s;
}

void Oracle::stopped(double shown_s) {
  report_.undriven_s = bench_.driven_until_s() - shown_s;
  if (report_.undriven_s > fault_.kind->stopped_within_s) {
    blame(fmt::format("nobody stopped driving the shaft for {:.3f} s, {:.3f} s is the limit",
                      report_.undriven_s, fault_.kind->stopped_within_s));
  }
}

void Oracle::released(double standstill_timeout_s) {
  const double given_up_s = bench_.driven_until_s() + standstill_timeout_s;
  // A shaft that hardly moved stands still from when it was driven no more.
  const double still_s = std::max(bench_.moved_until_s(), bench_.driven_until_s());
  double due_s = std::min(still_s, given_up_s);
  if (fault_.kind != nullptr) {
    if (fault_.kind->cuts_brake_off) return;
    if (fault_.kind->hides_standstill) due_s = given_up_s;
  }
  report_.released_s = bench_.braked_until_s() - due_s;
  if (report_.released_s > release_limit_s) {
    blame(fmt::format("the brake held {:.3f} s after standstill, {:.2f} s is the limit",
                      report_.released_s, release_limit_s));
  }
}

// Nobody gives a standstill up before the time-out, counted from the first request to stop. Nor, of
// course, where none was made: the comparison is false for NaN.
void Oracle::not_released_early(double stop_asked_s, double standstill_timeout_s) {
  if (!(bench_.released_rpm() > FaultBench::moves_rpm)) return;
  if (bench_.released_s() >= stop_asked_s + standstill_timeout_s) return;
  blame(fmt::format("the brake was released while the shaft turned at {:.0f} rpm",
                    bench_.released_rpm()));
}

// The verdict that a fault calls for, if it came while it still mattered.
void Oracle::on_ending(const Ending& ending) {
  if (fault_.kind == nullptr) {
    if (ending.outcome != Outcome::pass) blame("a sound bench: " + report_.outcome);
    return;
  }
  const FaultKind& kind = *fault_.kind;
  if (!kind.holds_from_start) {
    const bool is_over = fault_.state == BenchState::stopping;
    const bool is_early = fault_.state == BenchState::connecting && !matters_at_connect(kind);
    if (!report_.struck || is_over || is_early) return;
    if (kind.is_harmless_when && kind.is_harmless_when(fault_.state)) return;
  }
  if (!is_answered(kind.answer, ending)) {
    blame(fmt::format("the run ended {} ({}): {}", to_string(ending.outcome),
                      to_string(ending.error_kind), ending.reason));
  } else if (ending.reason.find(kind.words) == std::string::npos &&
             !ending.reason.starts_with("not every device answers: ")) {
    blame("the reason does not name \"" + kind.words + "\": " + ending.reason);
  }
}

}  // namespace rvbench::test
