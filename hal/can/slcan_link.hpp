#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>

#include "hal/bus_monitor.hpp"
#include "hal/can/serial_line.hpp"
#include "hal/can/slcan_frames.hpp"
#include "hal/can/slcan_transport.hpp"
#include "hal/clock.hpp"
#include "hal/inheriting_mutex.hpp"

namespace rvbench::hal {

/// The conversation with a LAWICEL adapter: SlcanTransport and its monitor share it.
///
/// Answers  only BEL does not say what it answers: it is taken for the older of the two questions
///          that can be open, a frame and the status flags
/// Flags    are asked for every 0.1 s while somebody sends or receives. Flags as they are at
///          bus-off, error-passive and a bus error together, are taken for it
/// Threads  one caller at a time; only count() may come from another thread, and holds nobody up:
///          while somebody receives it reads no line, and with the lock it has his priority
class SlcanLink {
 public:
  SlcanLink(SlcanOptions options, const Clock& clock)
      : options_(std::move(options)), clock_(clock) {}
  ~SlcanLink() { leave(); }
  SlcanLink(const SlcanLink&) = delete;
  SlcanLink& operator=(const SlcanLink&) = delete;

  Status open();
  Status send(const CanFrame& frame);
  Result<CanFrame> receive();
  void close();

  /// Asks for the flags anew before it answers.
  Result<BusCounters> count();

 private:
  using Deadline = std::chrono::steady_clock::time_point;

  Status set_up();
  Status command(const std::string& text, slcan_frames::LineKind answer, const char* operation,
                 Deadline end);
  Status drop_until_quiet(Deadline end);

  void take_lines();
  void digest(const slcan_frames::Line& line);
  void take(const CanFrame& frame);
  void take_flags(unsigned flags);
  void take_declined();
  void note(IoErrc code, const char* counter, const char* what);

  BusCounters counters() const;

  void watch();
  void ask_flags();
  void await_answer(const std::optional<double>& question, Deadline end);
  void lose(const std::string& why);
  void leave();
  IoError failure(IoErrc code, const std::string& operation) const;

  const SlcanOptions options_;
  const Clock& clock_;
  InheritingMutex mutex_;  ///< for all below
  SerialLine line_;
  slcan_frames::LineReader lines_;
  Deadline taken_;                       ///< when lines were taken last
  std::deque<CanFrame> frames_;          ///< let in, waiting for receive()
  std::optional<IoError> news_;          ///< to be told once, after the frames
  std::optional<double> frame_asked_s_;  ///< when the frame went that has no answer yet
  std::optional<double> flags_asked_s_;
  double flags_s_ = 0;  ///< when they last came
  std::string lost_ = "not open";
  std::map<std::string, std::uint64_t> counts_;
};

}  // namespace rvbench::hal
