#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "bench/serve/serial_rule.hpp"
#include "bench/serve/tokens.hpp"
#include "hal/config_reader.hpp"

namespace rvbench::bench {

/// Somebody who may log in at a station.
struct StationUser {
  std::string name;
  Role role = Role::viewer;
  std::string token_hash;  ///< as hash_of_token() makes it
};

/// An end-of-line station: what it runs on which rig, and who may do what there.
struct StationFile {
  std::string name;
  std::string plan;  ///< built-in name, or path
  std::string rig;   ///< "sim", or path
  std::filesystem::path runs = "runs";
  SerialRule serial;
  std::vector<StationUser> users;
  bool remote_start = false;  ///< a run may be started from another computer
  std::string bind = "127.0.0.1";
  int port = 8080;
  std::vector<std::string> hosts;  ///< names it is called by, besides those of this computer
  int most_connections = 64;
  int most_body_bytes = 64 * 1024;
};

/// Whether only this computer reaches what is bound to that address.
bool is_loopback(const std::string& address);

/// The station, or every fault of the file at once, those of its plan and rig included. Paths in it
/// are as seen from itself.
std::variant<StationFile, std::vector<hal::ConfigFault>> read_station(
    const std::filesystem::path& file);

/// A letter or digit, then up to 31 of those, '-' and '_': fit for a token and for a log.
bool is_user_name(const std::string& name);

}  // namespace rvbench::bench
