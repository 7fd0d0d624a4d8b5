#include "sequences/bench_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sequences/interlock_check.hpp"
#include "sequences/timeline.hpp"

namespace rvbench::sequences {
namespace {

constexpr double tick_s = 0.01;
constexpr double write_period_s = 0.1;  // well within any watchdog
constexpr double report_period_s = 0.5;
constexpr double longest_look_s = 2;  // at the counters of all buses
// A stop waits for the request to the drive that is under way, with all its repetitions.
constexpr double longest_wait_for_stop_s = 5;
// Two witnesses of one shaft: no limit on what is tested, but how far apart a sound pair may be.
// The drive's own speed may be an estimate that leaves slip out, a tenth at most of a motor within
// its rating. Its answer may be 0.05 s old and the angle's speed is a mean over 0.1 s: 60 rpm at a
// ramp of 600 rpm/s, and of a steeper one it is over within a second. A dead angle is far off.
constexpr double speeds_apart_rpm = 60;
constexpr double speeds_apart_share = 0.15;
constexpr double speeds_apart_s = 1.0;

Ending recording_failed(const IoError& error) {
  return {Outcome::error, ErrorKind::none, "the recording cannot be written: " + describe(error)};
}

}  // namespace

double load_torque_Nm(const Specimen& specimen, double load_pct) {
  return load_pct / 100 * specimen.rated_output_torque_Nm;
}

BenchLoop::BenchLoop(const TestPlan& plan, hal::Rig& rig, hal::RecordingWriter& recording,
                     RunObserver& observer, std::stop_token stop, int first_point)
    : plan_(plan),
      rig_(rig),
      recording_(recording),
      observer_(observer),
      stop_(std::move(stop)),
      first_point_(first_point),
      supervisor_(rig, plan.interlocks),
      devices_(rig, supervisor_),
      recorder_(recording),
      buses_(rig) {
  for (const Segment& segment : timeline(plan)) total_s_ += planned_s(segment);
}

// The plan does not know how late a rig tells of a hole: see await_sound_end().
double BenchLoop::planned_s(const Segment& segment) const {
  return segment.duration_s + (segment.recorded ? rig_.accelerometers->hole_told_after_s() : 0);
}

std::optional<Ending> BenchLoop::tick() {
  if (ended()) return ended();
  rig_.clock->wait_until(next_tick_s_);
  next_tick_s_ = std::max(next_tick_s_, now_s()) + tick_s;
  devices_.read();
  if (auto ending = trouble()) return end(*ending);
  if (now_s() >= next_write_s_) {
    next_write_s_ = now_s() + write_period_s - tick_s / 2;
    devices_.write(speed_rpm_, brake_torque_Nm_);
  }
  if (Status kept = recorder_.take(devices_.fresh()); !kept) {
    return end(recording_failed(kept.error()));
  }
  report_progress();
  return std::nullopt;
}

// What the supervisor has found comes first, but for a stop on request in the same moment.
std::optional<Ending> BenchLoop::trouble() {
  std::optional<Ending> ending = ended();
  if (stop_.stop_requested()) {
    const Ending asked{Outcome::aborted, ErrorKind::none, "stopped on request"};
    ending = ending ? graver(*ending, asked) : asked;
  }
  const double patience_s =
      supervisor_.is_tripped() ? longest_wait_for_stop_s : plan_.interlocks.stale_after_s;
  if (!ending && supervisor_.silence_s() > patience_s) {
    return device_lost(
        fmt::format("the supervisor has not come round for {:.2f} s: a device holds it",
                    supervisor_.silence_s()));
  }
  if (!ending && speeds_disagree()) {
    return device_lost(
        fmt::format("the drive reports {:.0f} rpm, the torque sensor's angle {:.0f} rpm",
                    devices_.values().drive.speed_rpm, devices_.measured_speed_rpm(0.1)));
  }
  return ending;
}

bool BenchLoop::speeds_disagree() {
  const double measured_rpm = devices_.measured_speed_rpm(0.1);
  const double apart_rpm = std::abs(devices_.values().drive.speed_rpm - measured_rpm);
  // Not known is no contradiction (the comparison is false for NaN), nor is a reading that is old.
  const bool apart = devices_.drive_is_fresh() &&
                     apart_rpm > speeds_apart_rpm + speeds_apart_share * std::abs(measured_rpm);
  if (!apart) agreed_s_ = now_s();
  return now_s() - agreed_s_ > speeds_apart_s;
}

Ending BenchLoop::end(const Ending& ending) {
  supervisor_.trip(ending);
  event(ending.reason);
  return ending;
}

std::optional<Ending> BenchLoop::arm() {
  next_tick_s_ = next_write_s_ = agreed_s_ = now_s();
  devices_.start();
  // Nothing turns before every device has answered; one that does not is lost within that time.
  // A shaft that still runs down from an earlier run is waited for.
  const Waited waited = run_until(
      [this](const BenchValues&) {
        return devices_.all_answered() && devices_.stands_still(plan_.teardown.standstill_rpm);
      },
      plan_.interlocks.stale_after_s + plan_.teardown.standstill_timeout_s);
  if (waited.ending) return waited.ending;
  if (!waited.met) return end(device_lost("the shaft turns before anybody has commanded it"));
  if (!supervisor_.handle(SupervisorEvent::reset) || !supervisor_.handle(SupervisorEvent::arm)) {
    return await_trip();
  }
  event(armed_event);
  if (const std::string why = supervisor_.without_priority(); !why.empty()) {
    event("the supervisor has no real-time priority: " + why);
  }
  return std::nullopt;
}

// One that has fallen tells its ending once the drive is stopped. Not for ever: a stop that hangs
// is trouble of its own.
Ending BenchLoop::await_trip() {
  if (!supervisor_.is_tripped()) {
    throw std::logic_error(
        fmt::format("BenchLoop::arm: already {}", to_string(supervisor_.state())));
  }
  for (;;) {
    if (const auto ending = tick()) return *ending;
  }
}

void BenchLoop::command(double speed_rpm, double brake_torque_Nm) {
  const bool may_turn =
      speed_rpm == 0 || supervisor_.handle(SupervisorEvent::run) || supervisor_.is_tripped();
  if (!may_turn) {
    throw std::logic_error(fmt::format("BenchLoop::command: {} rpm while {}", speed_rpm,
                                       to_string(supervisor_.state())));
  }
  speed_rpm_ = speed_rpm;
  has_turned_ = has_turned_ || speed_rpm != 0;
  brake_torque_Nm_ = brake_torque_Nm;
  next_write_s_ = now_s();
}

std::optional<Ending> BenchLoop::run_for(double duration_s) {
  return run_until([](const BenchValues&) { return false; }, duration_s).ending;
}

Waited BenchLoop::run_until(const std::function<bool(const BenchValues&)>& met, double timeout_s) {
  const double until_s = now_s() + timeout_s;
  while (now_s() < until_s - 1e-6) {
    if (auto ending = tick()) return {ending, false};
    if (met(devices_.values())) return {std::nullopt, true};
  }
  return {};
}

std::optional<int> BenchLoop::next_point() {
  const int point = next_point_++;
  return point < first_point_ ? std::nullopt : std::optional(point);
}

std::optional<Ending> BenchLoop::record_point(int point, double input_turns, double timeout_s) {
  const auto turn = [&] {
    return run_until([&](const BenchValues&) { return recorder_.covers(input_turns); }, timeout_s);
  };
  return record(point, "too_short", turn, [this] { return least_torque_Nm(); });
}

std::optional<Ending> BenchLoop::record_work(int point, const char* unmet,
                                             const std::function<Waited()>& work) {
  return record(point, unmet, work, [] { return not_known; });
}

// @param least_Nm  asked at its end: see PointRecorder::close()
std::optional<Ending> BenchLoop::record(int point, const char* unmet,
                                        const std::function<Waited()>& work,
                                        const std::function<double()>& least_Nm) {
  buses_.begin();
  if (auto ending = await_buses()) return ending;
  buses_.open_record();
  recorder_.open(point);
  const Waited waited = work();
  std::optional<Ending> ending = waited.ending;
  if (!ending) {
    recorder_.seal();
    buses_.end();
    ending = await_buses();
  }
  if (!ending && waited.met) ending = await_sound_end();
  if (ending) {
    interrupt_record();
    return ending;
  }
  const std::string bus_errors = buses_.verdict();
  const char* const status = !waited.met ? unmet : bus_errors.empty() ? "ok" : "bus_errors";
  const auto result = recorder_.close(status, least_Nm());
  if (!result) return end(recording_failed(result.error()));
  points_.push_back(result.value());
  event(fmt::format(point_event, point, result.value().status));
  if (!bus_errors.empty()) event(fmt::format("point {}: {}", point, bus_errors));
  return std::nullopt;
}

// The devices are watched meanwhile.
std::optional<Ending> BenchLoop::await_buses() {
  if (buses_.is_ready()) return std::nullopt;
  return run_until([this](const BenchValues&) { return buses_.is_ready(); }, longest_look_s).ending;
}

// A stream with a hole ends, and with it its accelerometers are lost.
std::optional<Ending> BenchLoop::await_sound_end() {
  const double told_after_s = rig_.accelerometers->hole_told_after_s();
  if (told_after_s <= 0) return std::nullopt;
  const auto is_told = [&](const BenchValues&) { return recorder_.is_followed_for(told_after_s); };
  const Waited waited = run_until(is_told, 2 * (told_after_s + plan_.interlocks.stale_after_s));
  if (waited.ending || waited.met) return waited.ending;
  return end(device_lost("accelerometers: no scans followed the record, which may have a hole"));
}

// A reducer puts out no more power than it takes in: half of what that asks for at the input
// leaves room for the errors of transducer and brake. NaN if the brake does not say what it holds.
double BenchLoop::least_torque_Nm() const {
  return 0.5 * devices_.values().brake.torque_Nm / plan_.specimen.gear_ratio;
}

void BenchLoop::interrupt_record() {
  if (!recorder_.is_open()) return;
  const auto result = recorder_.close("interrupted");
  if (result) points_.push_back(result.value());
}

std::optional<Ending> BenchLoop::give_up_point(const hal::PointResult& result) {
  points_.push_back(result);
  event(fmt::format(point_event, result.point, result.status));
  if (Status written = recording_.end_point(result); !written) {
    return end(recording_failed(written.error()));
  }
  return std::nullopt;
}

void BenchLoop::enter(const Segment& segment) {
  done_s_ += planned_s(segment_);
  segment_ = segment;
  segment_start_s_ = now_s();
}

void BenchLoop::event(const std::string& text) {
  observer_.event(now_s(), text);
  // A recording that cannot take a note cannot take samples either: those are checked.
  static_cast<void>(recording_.note(now_s(), text));
}

void BenchLoop::report_progress() {
  if (segment_.what.empty() || now_s() < next_report_s_) return;
  next_report_s_ = now_s() + report_period_s;
  // Settling may take longer than planned: progress waits for it.
  const double here_s = std::min(now_s() - segment_start_s_, planned_s(segment_));
  observer_.progress(done_s_ + here_s, total_s_, segment_.what);
}

}  // namespace rvbench::sequences
