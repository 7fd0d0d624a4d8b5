#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <string>
#include <string_view>

#include "hal/device_thread.hpp"
#include "hal/types/result.hpp"

namespace rvbench::hal {

/// A serial line or pseudo-terminal that hands bytes on as they are, 8N1, and never blocks.
///
/// Reading  in a thread of its own: Linux makes whoever reads or polls a terminal that has nothing
///          wait for the kernel's worker that fills it, O_NONBLOCK or not. That worker is an
///          ordinary thread, and on a busy computer 0.2 s late (n_tty_read and n_tty_poll flush its
///          work: drivers/tty/n_tty.c)
/// Alone    two readers would each get some of the bytes, and to either the device would seem
///          silent or garbled: the line is locked by flock(), as other terminal programs do
/// Errors   disconnected: no such device, another program has it, no terminal, hung up, its output
///          is stuck, or something was thrown in that thread
class SerialLine {
 public:
  /// @return false if termios knows no such rate
  static bool knows_baud(int baud);

  SerialLine() = default;
  ~SerialLine() { close(); }
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;

  /// Drops whatever waits in the line, both ways.
  Status open(const std::string& device, int baud);
  void close();
  bool is_open() const { return file_ >= 0; }

  /// All of it or nothing that can be relied on: on an error the line is of no more use.
  Status write(std::string_view bytes);

  /// What is there now, at most 64 kB of it. Empty is no silence: the reading thread may be just
  /// about to hand something over.
  Result<std::string> read();

  /// Waits until there is something to read, or the line hung up.
  /// @return false if neither came: the line was silent
  bool wait(std::chrono::milliseconds longest);

 private:
  void listen(const std::stop_token& stop);
  bool take(std::string& bytes, int& error) const;

  int file_ = -1;
  int wake_ = -1;  ///< becomes readable when the reading is to end

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable_any changed_;
  std::string waiting_;
  int error_ = 0;  ///< why nothing comes after that; 0 while something may

  DeviceThread reader_;
};

}  // namespace rvbench::hal
