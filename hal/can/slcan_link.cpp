#include "hal/can/slcan_link.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <mutex>
#include <thread>
#include <utility>

namespace rvbench::hal {
namespace {

using slcan_frames::Line;
using slcan_frames::LineKind;
using std::chrono::milliseconds;
using RealClock = std::chrono::steady_clock;

constexpr milliseconds longest_taking{2};  // of a frame: the adapter only puts it into its queue
constexpr milliseconds longest_open{2000};
constexpr milliseconds longest_count{250};
constexpr milliseconds idle{10};  // after that nobody receives
constexpr milliseconds longest_close{100};
constexpr milliseconds quiet{20};  // USB hands bytes on in bunches, 16 ms apart
constexpr double flags_period_s = 0.1;
constexpr double silence_s = 1;  // an adapter that owes an answer for so long is gone
constexpr std::size_t most_frames = 4096;

constexpr unsigned frames_lost =
    slcan_frames::receive_queue_full | slcan_frames::send_queue_full | slcan_frames::data_overrun;
constexpr unsigned as_at_bus_off = slcan_frames::error_passive | slcan_frames::bus_error;

// Losing an arbitration is not counted: that is how CAN works.
constexpr std::array<std::pair<unsigned, const char*>, 7> counted_flags{
    {{slcan_frames::receive_queue_full, "receive_queue_full"},
     {slcan_frames::send_queue_full, "send_queue_full"},
     {slcan_frames::error_warning, "error_warning"},
     {slcan_frames::data_overrun, "data_overrun"},
     {slcan_frames::error_passive, "error_passive"},
     {slcan_frames::bus_error, "bus_error"},
     {slcan_frames::bus_off, "bus_off"}}};

milliseconds until(RealClock::time_point end) {
  return std::chrono::ceil<milliseconds>(end - RealClock::now());
}

}  // namespace

Status SlcanLink::open() {
  const std::lock_guard lock(mutex_);
  leave();
  lines_.clear();
  frames_.clear();
  news_.reset();
  frame_asked_s_.reset();
  flags_asked_s_.reset();
  const Status opened = line_.open(options_.device, options_.baud);
  if (!opened) return failure(opened.error().code, opened.error().where);
  Status ready = set_up();
  if (!ready) leave();
  flags_s_ = clock_.now_s();
  return ready;
}

// A command that was left half said is ended first, and alone: some adapters drop what comes with
// it. The version is an answer that nothing else looks like: what came before it is old.
Status SlcanLink::set_up() {
  const auto end = RealClock::now() + longest_open;
  Status done = line_.write("\r");
  if (!done) return failure(done.error().code, done.error().where);
  (void)drop_until_quiet(RealClock::now() + quiet);
  done = command("C\rV\r", LineKind::version, "open: V", end);
  if (done) done = drop_until_quiet(end);
  if (done) {
    done = command(*slcan_frames::command_from_bitrate(options_.bitrate_kbit_s), LineKind::done,
                   "open: set the bit rate", end);
  }
  if (done) done = command("O\r", LineKind::done, "open: O", end);
  if (done) done = command("F\r", LineKind::flags, "open: the adapter tells no status flags", end);
  return done;
}

Status SlcanLink::command(const std::string& text, LineKind answer, const char* operation,
                          Deadline end) {
  const Status written = line_.write(text);
  if (!written) return failure(written.error().code, written.error().where);
  const bool may_be_declined = answer != LineKind::version;  // C is, where the channel is closed
  for (;;) {
    while (const auto line = lines_.next()) {
      if (line->kind == answer) return Done{};
      if (line->kind == LineKind::declined && may_be_declined) {
        return failure(IoErrc::refused, operation);
      }
    }
    if (RealClock::now() >= end) return failure(IoErrc::timeout, operation);
    (void)line_.wait(until(end));
    const auto bytes = line_.read();
    if (!bytes) return failure(bytes.error().code, bytes.error().where);
    lines_.add(bytes.value());
  }
}

Status SlcanLink::drop_until_quiet(Deadline end) {
  while (RealClock::now() < end) {
    if (!line_.wait(quiet)) {
      lines_.clear();
      return Done{};
    }
    const auto bytes = line_.read();
    if (!bytes) return failure(bytes.error().code, bytes.error().where);
  }
  return failure(IoErrc::bad_reply, "open: the line does not fall silent");
}

Status SlcanLink::send(const CanFrame& frame) {
  const std::string command = slcan_frames::command_from(frame);
  const std::lock_guard lock(mutex_);
  take_lines();
  await_answer(frame_asked_s_, RealClock::now() + longest_taking);
  watch();
  if (!line_.is_open()) return failure(IoErrc::disconnected, "send: " + lost_);
  if (frame_asked_s_) {
    return failure(IoErrc::timeout, "send: the frame before is not acknowledged yet");
  }
  if (const Status written = line_.write(command); !written) {
    lose(written.error().where);
    return failure(IoErrc::disconnected, "send: " + lost_);
  }
  frame_asked_s_ = clock_.now_s();
  return Done{};
}

Result<CanFrame> SlcanLink::receive() {
  const std::lock_guard lock(mutex_);
  if (frames_.empty()) {
    take_lines();
    watch();
  }
  if (!frames_.empty()) {
    const CanFrame frame = frames_.front();
    frames_.pop_front();
    return frame;
  }
  if (news_) return *std::exchange(news_, std::nullopt);
  if (!line_.is_open()) return failure(IoErrc::disconnected, "receive: " + lost_);
  return failure(IoErrc::timeout, "receive");
}

Result<BusCounters> SlcanLink::count() {
  const auto end = RealClock::now() + longest_count;
  for (bool has_asked = false;;) {
    {
      const std::lock_guard lock(mutex_);
      if (RealClock::now() - taken_ > idle) take_lines();
      if (!line_.is_open()) return failure(IoErrc::disconnected, "count: " + lost_);
      if (!flags_asked_s_) {
        if (has_asked) return counters();
        ask_flags();  // those that were asked for earlier say nothing about now
        has_asked = true;
      }
    }
    if (RealClock::now() >= end) return failure(IoErrc::timeout, "count: no status flags");
    std::this_thread::sleep_for(milliseconds(1));
  }
}

BusCounters SlcanLink::counters() const {
  BusCounters counters{options_.device, counts_};
  for (const auto& [flag, name] : counted_flags) counters.counts.try_emplace(name, 0);
  return counters;
}

void SlcanLink::close() {
  const std::lock_guard lock(mutex_);
  // Its answer shows that it heard: what it has not taken is thrown away with the line. A frame's
  // may look alike, and comes first.
  await_answer(frame_asked_s_, RealClock::now() + longest_close);
  if (line_.is_open()) {
    (void)command("C\r", LineKind::done, "close", RealClock::now() + longest_close);
  }
  leave();
}

void SlcanLink::take_lines() {
  if (!line_.is_open()) return;
  taken_ = RealClock::now();
  const auto bytes = line_.read();
  if (!bytes) return lose(bytes.error().where);
  lines_.add(bytes.value());
  while (line_.is_open()) {
    const auto line = lines_.next();
    if (!line) return;
    digest(*line);
  }
}

void SlcanLink::digest(const Line& line) {
  switch (line.kind) {
    case LineKind::frame: return take(line.frame);
    case LineKind::remark: return take_flags(line.flags);
    case LineKind::declined: return take_declined();
    case LineKind::garbled: return note(IoErrc::bad_reply, "garbled_lines", "a garbled line");
    case LineKind::done:
    case LineKind::sent:
      if (frame_asked_s_) return frame_asked_s_.reset();
      return note(IoErrc::bad_reply, "stray_answers", "an answer to nothing");
    case LineKind::flags:
      if (!flags_asked_s_)
        return note(IoErrc::bad_reply, "stray_answers", "flags without a question");
      flags_asked_s_.reset();
      flags_s_ = clock_.now_s();
      return take_flags(line.flags);
    case LineKind::other_frame:
    case LineKind::version: return;
  }
}

void SlcanLink::take(const CanFrame& frame) {
  if (std::ranges::find(options_.ids, frame.id) == options_.ids.end()) return;
  if (frames_.size() == most_frames) {
    frames_.pop_front();
    note(IoErrc::overrun, "frames_not_fetched", "frames waited too long");
  }
  frames_.push_back(frame);
  frames_.back().time_s = clock_.now_s();
}

void SlcanLink::take_flags(unsigned flags) {
  if ((flags & as_at_bus_off) == as_at_bus_off) flags |= slcan_frames::bus_off;
  for (const auto& [flag, name] : counted_flags) {
    if ((flags & flag) != 0) ++counts_[name];
  }
  if ((flags & frames_lost) != 0 && !news_) {
    news_ = failure(IoErrc::overrun, "receive: the adapter lost frames");
  }
  if ((flags & slcan_frames::bus_off) != 0) lose("the controller went bus-off");
}

void SlcanLink::take_declined() {
  if (frame_asked_s_ && !(flags_asked_s_ && *flags_asked_s_ < *frame_asked_s_)) {
    frame_asked_s_.reset();
    return note(IoErrc::overrun, "send_declined", "the adapter declined a frame");
  }
  if (flags_asked_s_) return lose("the adapter has closed its channel");
  note(IoErrc::bad_reply, "stray_answers", "an answer to nothing");
}

void SlcanLink::note(IoErrc code, const char* counter, const char* what) {
  ++counts_[counter];
  if (!news_) news_ = failure(code, std::string("receive: ") + what);
}

void SlcanLink::watch() {
  if (!line_.is_open()) return;
  const double now_s = clock_.now_s();
  for (const auto& asked_s : {frame_asked_s_, flags_asked_s_}) {
    if (asked_s && now_s - *asked_s > silence_s) return lose("the adapter fell silent");
  }
  if (!flags_asked_s_ && now_s - flags_s_ >= flags_period_s) ask_flags();
}

void SlcanLink::ask_flags() {
  const Status written = line_.write("F\r");
  if (!written) return lose(written.error().where);
  flags_asked_s_ = clock_.now_s();
}

// Lines that come meanwhile are taken in.
void SlcanLink::await_answer(const std::optional<double>& question, Deadline end) {
  while (line_.is_open() && question && RealClock::now() < end) {
    (void)line_.wait(until(end));
    take_lines();
  }
}

void SlcanLink::lose(const std::string& why) {
  leave();
  lost_ = why;
}

// The adapter leaves the bus, if it still hears.
void SlcanLink::leave() {
  if (line_.is_open()) (void)line_.write("C\r");
  line_.close();
  lost_ = "not open";
}

IoError SlcanLink::failure(IoErrc code, const std::string& operation) const {
  return {code, fmt::format("CAN {}: {}", options_.device, operation)};
}

}  // namespace rvbench::hal
