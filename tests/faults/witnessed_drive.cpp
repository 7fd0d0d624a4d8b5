#include "tests/faults/witnessed_drive.hpp"

#include <chrono>
#include <cmath>

namespace rvbench::test {
namespace {

constexpr double speed_resolution_rpm = 0.1;  // of the drive's register

}  // namespace

class WitnessedDrive::Call {
 public:
  explicit Call(WitnessedDrive& drive) : drive_(drive), before_(drive.server_.misbehaved()) {}
  ~Call() {
    const double took_s = std::chrono::duration<double>(Clock::now() - began_).count();
    const bool is_planned = drive_.server_.misbehaved() > drive_.misbehaved_;
    drive_.misbehaved_ = before_;
    if (took_s >= drive_.patience_s_ && !is_planned) drive_.witness_.held_up = true;
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  WitnessedDrive& drive_;
  int before_;
  Clock::time_point began_ = Clock::now();
};

Status WitnessedDrive::connect() {
  const Call call(*this);
  return drive_->connect();
}

Result<hal::DriveWatchdog> WitnessedDrive::read_watchdog() {
  const Call call(*this);
  return drive_->read_watchdog();
}

Status WitnessedDrive::set_speed(double speed_rpm) {
  const Call call(*this);
  if (speed_rpm != 0) {
    asked_to_turn_ = true;
    witness_.stop_asked_s = not_known;
  }
  return drive_->set_speed(speed_rpm);
}

Result<hal::DriveStatus> WitnessedDrive::read() {
  const Call call(*this);
  const double shown_rpm = model_.state().speed_rpm;
  const int misbehaved = server_.misbehaved();
  auto status = drive_->read();
  const bool is_sound = status && server_.misbehaved() == misbehaved;
  if (is_sound && !(std::abs(status.value().speed_rpm - shown_rpm) <= speed_resolution_rpm)) {
    ++witness_.belated_readings;
  }
  return status;
}

void WitnessedDrive::stop() noexcept {
  const Call call(*this);
  if (std::exchange(asked_to_turn_, false)) witness_.stop_asked_s = clock_.now_s();
  drive_->stop();
}

}  // namespace rvbench::test
