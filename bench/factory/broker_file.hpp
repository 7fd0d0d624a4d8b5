#pragma once

#include <string>
#include <variant>
#include <vector>

#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// Where results go, and as whom: a broker file.
struct Broker {
  std::string host;
  int port = 1883;
  /// File of the authorities that may sign the broker's certificate; "": no TLS.
  std::string ca = {};
  std::string user = {}, password = {};
  std::string client_id = {};
  int qos = 1;
  std::string topic = {};  ///< of results
  std::string step = {};   ///< what the factory calls this test; "": it has no name for it
  int keep_alive_s = 30;

  /// Beside `topic`: "online", and "offline" once it has gone, however it went; retained.
  std::string status_topic() const;
  /// For people: "factory.example:8883".
  std::string address() const;
};

/// Reads a broker file; paths in it are seen from its folder. The password comes from a file that
/// nobody but its owner may read, so that it is in no command line, log or broker file.
/// @return the broker, or every fault of the file
std::variant<Broker, std::vector<hal::ConfigFault>> read_broker(const std::string& file);

/// What is allowed, but should be known: a password that goes over the network in the open.
std::vector<hal::ConfigFault> remarks_on(const Broker& broker);

}  // namespace rvbench::bench
