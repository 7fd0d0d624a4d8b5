#pragma once

#include <memory>
#include <string>

#include "tests/support/loopback.hpp"
#include "tests/support/program.hpp"

namespace rvbench::test {

/// A broker that is not ours, on a port of this computer of its own, which it keeps when it is
/// killed and started again.
class Mosquitto {
 public:
  /// @param settings  lines of its configuration besides, instead of which everybody may come in
  explicit Mosquitto(std::string settings = "allow_anonymous true");

  void start();  ///< and waits until it listens
  bool send(int signal) const { return program_ && program_->send(signal); }
  void kill();  ///< kill -9
  std::string log() const { return log_ + (program_ ? program_->said() : ""); }
  int port() const { return port_of(reserved_); }
  const ScratchFolder& folder() const { return folder_; }

  /// How often a PUBLISH with this topic has come, as the broker tells it: "d0, q1" is a first
  /// sending at QoS 1, "d1, q2" a repeated one at QoS 2.
  int publications(const std::string& how, const std::string& topic) const;

  /// What has arrived on its connections and it has not read, in bytes.
  unsigned long unread_bytes() const;

 private:
  ScratchFolder folder_;
  Socket reserved_;
  std::string settings_, log_;
  std::unique_ptr<Program> program_;
};

}  // namespace rvbench::test
