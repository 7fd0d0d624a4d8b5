#include "sequences/supervisor.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <mutex>
#include <utility>

#include "hal/real_time.hpp"
#include "sequences/interlock_check.hpp"

namespace rvbench::sequences {
namespace {

constexpr std::size_t most_rounds_kept = 60'000;  // a minute

}  // namespace

Supervisor::Supervisor(hal::Rig& rig, const Interlocks& limits)
    : rig_(rig), limits_(limits), field_(rig) {}

Supervisor::~Supervisor() {
  if (!end()) std::terminate();  // better than a thread that goes on in memory that is no more
}

void Supervisor::start(const DriveReport& drive) {
  drive_ = drive;
  field_.start();
  is_watching_ = true;
  if (rig_.clock->is_virtual()) return;
  round_s_ = heard_s_ = rig_.clock->now_s();
  is_gone_ = false;
  has_thread_ = true;  // which it knows itself by
  try {
    thread_ = std::jthread([this](const std::stop_token& stop) {
      run(stop);
      is_gone_ = true;
    });
  } catch (...) {
    has_thread_ = false;
    throw;
  }
}

bool Supervisor::end() noexcept {
  is_watching_ = false;
  if (!thread_.joinable()) return !has_thread_;
  thread_.request_stop();
  // No promise: a broken one asks for memory where nothing may be thrown.
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> longest(longest_end_s);
  while (!is_gone_ && std::chrono::steady_clock::now() - start < longest) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  if (!is_gone_) {
    thread_.detach();
    return false;
  }
  thread_.join();
  has_thread_ = false;
  return true;
}

void Supervisor::run(const std::stop_token& stop) noexcept {
  double next_s = rig_.clock->now_s();
  bool is_urgent = false;
  while (!stop.stop_requested()) {
    try {
      if (!std::exchange(is_urgent, true)) tell_priority(hal::make_this_thread_urgent());
      rig_.clock->wait_until(next_s);
      const double now_s = rig_.clock->now_s();
      round_s_ = now_s;
      lateness_.add(now_s - next_s);
      next_s = std::max(next_s + period_s, now_s);  // rounds that were missed are not made up for
      step();
      const bool all_live = now_s - heard_s_ < longest_pause_s;
      if (all_live && !stop.stop_requested()) service_.feed(now_s);
    } catch (const std::exception& exception) {
      fault(exception.what());
    } catch (...) {
      fault("of unknown kind");
    }
  }
}

// The stop first: telling why asks for memory, and there may be none left.
void Supervisor::fault(const char* what) noexcept {
  halt();
  try {
    trip({Outcome::error, ErrorKind::none,
          std::string("internal error of the supervisor: ") + what});
  } catch (...) {
    const std::lock_guard lock(mutex_);
    // A text as short as this one needs no memory of its own.
    if (!latched_) latched_.emplace(Ending{Outcome::error, ErrorKind::none, "no memory left"});
  }
}

// One round. What the sequencer has just told may wait for the next one if it holds the lock.
void Supervisor::step() {
  std::optional<double> brake_Nm;
  if (std::unique_lock lock(mutex_, std::try_to_lock); lock) {
    if (told_drive_) drive_ = *std::exchange(told_drive_, std::nullopt);
    brake_Nm = std::exchange(told_brake_Nm_, std::nullopt);
  }
  FreshValues fresh = field_.read();
  fresh.drive = std::exchange(drive_.fresh, std::nullopt);
  look_for_trouble(fresh);
  if (brake_Nm && is_watching_) field_.hold_brake(*brake_Nm);
  hand_over(std::move(fresh));
}

void Supervisor::look_for_trouble(const FreshValues& fresh) {
  if (!is_watching_ || is_latched_ || state_ == SupervisorState::stopping) return;
  if (const auto beyond = check_interlocks(limits_, fresh)) return trip(*beyond);
  if (const auto fault = check_devices(fresh)) return trip(*fault);
  if (std::string silent = lost(); !silent.empty()) trip(device_lost(std::move(silent)));
}

// What will be too old before the next round is too old now.
std::string Supervisor::lost() const {
  const double now_s = rig_.clock->now_s();
  const double stale_after_s = limits_.stale_after_s - (has_thread_ ? period_s : 0);
  std::string all;
  for (const std::string& one :
       {drive_.status.lost(now_s, stale_after_s), drive_.command.lost(now_s, stale_after_s),
        field_.lost(stale_after_s)}) {
    if (!one.empty()) all += (all.empty() ? "" : "; ") + one;
  }
  return all;
}

// A sequencer that takes nothing has been stopped by the age of the drive's answers long before
// the memory is full of what it left.
void Supervisor::hand_over(FreshValues fresh) {
  if (kept_.size() < most_rounds_kept) kept_.push_back(std::move(fresh));
  std::unique_lock lock(mutex_, std::defer_lock);
  if (!has_thread_) {
    lock.lock();
  } else if (!lock.try_lock()) {
    return;
  }
  if (ready_.size() < most_rounds_kept) {
    std::ranges::move(kept_, std::back_inserter(ready_));
    kept_.clear();
  }
  all_answered_ = field_.all_answered();
  lost_ = lost();
}

Handover Supervisor::exchange(const DriveReport& drive) {
  hear_sequencer();
  tell(drive);
  if (!has_thread_) step();
  std::vector<FreshValues> rounds;
  Handover taken;
  {
    const std::lock_guard lock(mutex_);
    rounds.swap(ready_);
    taken.all_answered = all_answered_;
    taken.lost = lost_;
  }
  taken.fresh = merged(std::move(rounds));
  return taken;
}

// A status that the supervisor has not seen yet is not to be lost for a report without news.
void Supervisor::tell(const DriveReport& drive) {
  const std::lock_guard lock(mutex_);
  std::optional<hal::DriveStatus> unseen;
  if (told_drive_) unseen = told_drive_->fresh;
  told_drive_ = drive;
  if (!told_drive_->fresh) told_drive_->fresh = unseen;
}

void Supervisor::hold_brake(double torque_Nm) {
  if (!has_thread_) return field_.hold_brake(torque_Nm);
  const std::lock_guard lock(mutex_);
  told_brake_Nm_ = torque_Nm;
}

// Asked afterwards, too: a trip that fell in between may have moved the state before this did.
bool Supervisor::handle(SupervisorEvent event) noexcept {
  const bool leads_to_motion = event == SupervisorEvent::reset || event == SupervisorEvent::arm ||
                               event == SupervisorEvent::run;
  if (leads_to_motion && is_latched_) return false;
  if (!move(event)) return false;
  if (!leads_to_motion || !is_latched_) return true;
  move(SupervisorEvent::trip);
  return false;
}

bool Supervisor::move(SupervisorEvent event) noexcept {
  SupervisorState state = state_;
  for (;;) {
    const auto next = next_state(state, event);
    if (!next) return false;
    if (state_.compare_exchange_weak(state, *next)) return true;
  }
}

void Supervisor::trip(const Ending& ending) {
  halt();
  const std::lock_guard lock(mutex_);
  latched_ = latched_ ? graver(*latched_, ending) : ending;
}

// Before anything that may take its time.
void Supervisor::halt() noexcept {
  if (is_latched_.exchange(true)) return;
  move(SupervisorEvent::trip);
  latched_s_ = rig_.clock->now_s();
  rig_.drive->stop();
  has_stopped_drive_ = true;
}

double Supervisor::silence_s() const { return has_thread_ ? rig_.clock->now_s() - round_s_ : 0; }

std::optional<Ending> Supervisor::latched() const {
  const std::lock_guard lock(mutex_);
  return latched_;
}

void Supervisor::tell_priority(std::string without) {
  const std::lock_guard lock(mutex_);
  without_priority_ = std::move(without);
}

std::string Supervisor::without_priority() const {
  const std::lock_guard lock(mutex_);
  return without_priority_;
}

Lateness Supervisor::lateness() const { return lateness_; }

}  // namespace rvbench::sequences
