#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/http_client.hpp"
#include "tests/support/program.hpp"

namespace rvbench::test {

/// The plan "quick" at its highest speed alone: the thread sanitizer takes a minute for two points.
std::string quick_at_top_speed();

/// A run of that plan and its judgement, on a busy computer.
constexpr std::chrono::seconds longest_run{180};

/// `rvbench serve` on a free port, with a simulated bench and a user for each role.
class ServedStation {
 public:
  /// @param keys  of the station file, besides name, rig and users: "\"plan\": \"quick\""
  explicit ServedStation(const ScratchFolder& scratch, const std::string& keys,
                         const std::string& rig = "sim");

  std::uint16_t port() const { return port_; }
  Program& program() { return program_; }

  /// Asks without being logged in, or as who logged in last.
  HttpReply get(const std::string& target);
  HttpReply post(const std::string& target, const std::string& body = "{}",
                 const HttpHeaders& headers = {});
  HttpReply log_in(const std::string& user);
  void forget_login() { cookie_ = csrf_ = ""; }
  const std::string& csrf() const { return csrf_; }
  HttpHeaders cookie() const;

  /// A connection that server-sent events come on.
  Socket listen();

 private:
  Program program_;
  std::uint16_t port_ = 0;
  std::string cookie_, csrf_;
};

/// The token of "vera" (viewer), "otto" (operator) or "anna" (engineer).
std::string token_of(const std::string& user);

/// The data of the last event of that name in a stream; null if there is none.
nlohmann::json last_event(const std::string& stream, const std::string& name);

}  // namespace rvbench::test
