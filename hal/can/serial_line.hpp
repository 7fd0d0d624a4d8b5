#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "hal/types/result.hpp"

namespace rvbench::hal {

/// A serial line or pseudo-terminal that hands bytes on as they are, 8N1, and never blocks.
///
/// Errors   disconnected: no such device, no terminal, hung up, or its output is stuck
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

  /// What is there now, at most 64 kB of it; empty if nothing is.
  Result<std::string> read();

  /// Waits until there is something to read, or the line hung up.
  void wait(std::chrono::milliseconds longest) const;

 private:
  int file_ = -1;
};

}  // namespace rvbench::hal
