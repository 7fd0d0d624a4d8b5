#pragma once

#include <string>

namespace rvbench::sim {

/// A pseudo-terminal that hands bytes on as they are: what a simulated device on a serial line
/// serves at. It keeps no baud rate: bytes are there at once.
class PseudoTerminal {
 public:
  /// @throws std::runtime_error if there is none to be had
  PseudoTerminal();
  ~PseudoTerminal() { close(); }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int master() const { return master_; }                 ///< the device's end
  const std::string& device() const { return device_; }  ///< what a client opens

 private:
  [[noreturn]] void refuse();
  void close();

  int master_ = -1;
  int slave_ = -1;  ///< held open by us too: else the line would break when a client leaves
  std::string device_;
};

}  // namespace rvbench::sim
