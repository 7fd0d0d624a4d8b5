#include "sequences/written_behind.hpp"

#include <fmt/format.h>

#include <exception>
#include <utility>

namespace rvbench::sequences {
namespace {

constexpr std::size_t bytes_of_a_line = 512;
constexpr double longest_farewell_s = 1;

// What cannot be told is no reason to end a run.
template <typename Tell>
void quietly(Tell&& tell) {
  try {
    tell();
  } catch (...) {
  }
}

std::size_t bytes_of(const hal::AccelerationBlock& block) {
  return sizeof(float) * static_cast<std::size_t>(block.scans.size()) + bytes_of_a_line;
}

std::size_t bytes_of(const hal::TorqueBlock& block) {
  return sizeof(hal::TorqueSample) * block.samples.size() + bytes_of_a_line;
}

}  // namespace

Status RecordingBehind::append(int point, const hal::AccelerationBlock& block) {
  return post(bytes_of(block), [this, point, block] { return recording_.append(point, block); });
}

Status RecordingBehind::append(int point, const hal::TorqueBlock& block) {
  return post(bytes_of(block), [this, point, block] { return recording_.append(point, block); });
}

Status RecordingBehind::end_point(const hal::PointResult& result) {
  return post(bytes_of_a_line, [this, result] { return recording_.end_point(result); });
}

Status RecordingBehind::note(double time_s, const std::string& event) {
  return post(bytes_of_a_line, [this, time_s, event] { return recording_.note(time_s, event); });
}

Status RecordingBehind::settle() {
  scribe_.finish();
  return so_far();
}

Status RecordingBehind::post(std::size_t bytes, std::function<Status()> write) {
  if (const Status status = so_far(); !status) return status;
  const bool is_taken = scribe_.post(bytes, [this, write = std::move(write)] {
    if (!so_far()) return;  // a recording with a hole in it must not look whole
    try {
      if (const Status written = write(); !written) fail(written.error());
    } catch (const std::exception& bug) {
      fail({IoErrc::refused, std::string("recording: ") + bug.what()});
    }
  });
  if (!is_taken) fail({IoErrc::overrun, "recording: the disk has fallen too far behind"});
  return so_far();
}

Status RecordingBehind::so_far() const {
  const std::lock_guard lock(mutex_);
  if (failure_) return *failure_;
  // Where there was no memory to say more.
  if (scribe_.has_failed()) return IoError{IoErrc::refused, "recording: a part was not written"};
  return Done{};
}

void RecordingBehind::fail(IoError error) {
  const std::lock_guard lock(mutex_);
  if (!failure_) failure_ = std::move(error);
}

// The jobs know the observer alone: one that hangs may outlive this object.
void ObserverBehind::progress(double done_s, double total_s, const std::string& doing) {
  if (screen_.is_busy()) return;
  (void)screen_.post(0, [&observer = observer_, done_s, total_s, doing] {
    quietly([&] { observer.progress(done_s, total_s, doing); });
  });
}

void ObserverBehind::event(double time_s, const std::string& text) {
  if (untold_ > 0 && tell(time_s, fmt::format("{} events were left out here: the log was too far "
                                              "behind, the recording has them",
                                              untold_))) {
    untold_ = 0;
  }
  if (untold_ > 0 || !tell(time_s, text)) ++untold_;
}

bool ObserverBehind::tell(double time_s, const std::string& text) {
  return log_.post(bytes_of_a_line + text.size(), [&observer = observer_, time_s, text] {
    quietly([&] { observer.event(time_s, text); });
  });
}

bool ObserverBehind::finish() {
  const std::size_t unwritten = log_.finish_within(longest_farewell_s);
  untold_ += unwritten;
  return screen_.finish_within(longest_farewell_s) == 0 && unwritten == 0;
}

}  // namespace rvbench::sequences
