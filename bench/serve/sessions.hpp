#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "bench/seconds_source.hpp"
#include "bench/serve/tokens.hpp"

namespace rvbench::bench {

/// Somebody who is logged in.
struct Session {
  std::string user;
  Role role = Role::viewer;
  std::string csrf;  ///< what each of its calls that changes something must carry
};

/// Who is logged in, by what their cookie holds. A restart forgets all of them.
///
/// Threads  any
class Sessions {
 public:
  static constexpr double longest_s = 12 * 3600;  ///< a shift and its overtime
  static constexpr std::size_t most = 200;        ///< beyond, the oldest is logged out

  explicit Sessions(SecondsSource now_s = steady_s) : now_s_(std::move(now_s)) {}

  /// @return what the cookie is to hold: 256 random bits
  std::string begin(const std::string& user, Role role);
  std::optional<Session> find(const std::string& cookie);
  void end(const std::string& cookie);

 private:
  struct Entry {
    Session session;
    double begun_s;
  };
  void forget();

  SecondsSource now_s_;
  std::mutex mutex_;
  std::map<std::string, Entry> entries_;  // by the hash of the cookie
};

}  // namespace rvbench::bench
