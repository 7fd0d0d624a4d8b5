#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/serve/http.hpp"
#include "bench/serve/sessions.hpp"

namespace rvbench::bench {

/// Who may come in: what is refused before anything of a request is done.
///
/// Host     the station's own names alone: a foreign name that leads here (DNS rebinding) is not
///          one of them (403 "host")
/// Origin   where a browser states one, the page's own alone; no page of another site's asks for
///          anything of /api/ (403 "origin")
/// Session  whatever is below /api/, but for logging in (401 "login")
/// CSRF     every POST but logging in carries the session's own word (403 "csrf")
class Gate {
 public:
  /// @param hosts  names, each with or without port; one without is called at `port`
  Gate(std::vector<std::string> hosts, int port, Sessions& sessions);

  std::optional<HttpAnswer> refused(const HttpRequest& request) const;
  /// Of the request's cookie.
  std::optional<Session> session_of(const HttpRequest& request) const;

 private:
  bool is_host(const std::string& host) const;

  std::vector<std::string> hosts_;  // with port where it is not that of HTTP
  Sessions& sessions_;
};

inline constexpr const char* session_cookie = "rvbench_session";

/// The value of a cookie in a Cookie header; "" if it is not there.
std::string cookie_in(const std::string& header, const std::string& name);

}  // namespace rvbench::bench
