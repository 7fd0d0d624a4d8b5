#include "bench/serve/gate.hpp"

#include <algorithm>

#include "bench/lower_case.hpp"

namespace rvbench::bench {
namespace {

constexpr int port_of_http = 80;

bool is_of_api(const HttpRequest& request) { return request.path.starts_with("/api/"); }

}  // namespace

std::string cookie_in(const std::string& header, const std::string& name) {
  for (std::size_t at = 0; at < header.size();) {
    const std::size_t end = std::min(header.find(';', at), header.size());
    const std::size_t first = header.find_first_not_of(' ', at);
    if (first == std::string::npos) break;
    if (header.compare(first, name.size() + 1, name + "=") == 0) {
      return header.substr(first + name.size() + 1, end - first - name.size() - 1);
    }
    at = end + 1;
  }
  return "";
}

Gate::Gate(std::vector<std::string> hosts, int port, Sessions& sessions)
    : hosts_(std::move(hosts)), sessions_(sessions) {
  for (std::string& host : hosts_) {
    host = lower_case(host);
    if (host_and_port(host).port.empty() && port != port_of_http)
      host += ":" + std::to_string(port);
  }
}

bool Gate::is_host(const std::string& host) const {
  return std::ranges::find(hosts_, lower_case(host)) != hosts_.end();
}

std::optional<Session> Gate::session_of(const HttpRequest& request) const {
  const std::string cookie = cookie_in(request.header("cookie"), session_cookie);
  return cookie.empty() ? std::nullopt : sessions_.find(cookie);
}

std::optional<HttpAnswer> Gate::refused(const HttpRequest& request) const {
  const std::string host = request.header("host");
  if (!is_host(host)) return refusal(403, "host");
  const std::string origin = lower_case(request.header("origin"));
  const bool is_own =
      origin == "http://" + lower_case(host) || origin == "https://" + lower_case(host);
  if (!origin.empty() && !is_own) return refusal(403, "origin");
  if (!is_of_api(request)) return std::nullopt;
  const std::string site = request.header("sec-fetch-site");
  if (site == "cross-site" || site == "same-site") return refusal(403, "origin");
  if (request.method == "POST" && request.path == "/api/login") return std::nullopt;
  const auto session = session_of(request);
  if (!session) return refusal(401, "login");
  if (request.method != "POST") return std::nullopt;
  if (!are_same_secret(request.header("x-csrf-token"), session->csrf)) return refusal(403, "csrf");
  return std::nullopt;
}

}  // namespace rvbench::bench
