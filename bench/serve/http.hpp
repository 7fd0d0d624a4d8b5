#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rvbench::bench {

/// What a client asks for. Names of headers are in lower case; of several alike the first counts.
struct HttpRequest {
  std::string method, path;  ///< the path without its query, and with %xx decoded
  std::map<std::string, std::string> headers = {};
  std::map<std::string, std::string> query = {};
  std::string body = {};
  std::string address = {};  ///< of the client: "127.0.0.1"

  std::string header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? "" : found->second;
  }
  std::string parameter(const std::string& name) const {
    const auto found = query.find(name);
    return found == query.end() ? "" : found->second;
  }
};

/// Sends a part of an answer that goes on; false once nobody takes it any more.
using HttpSend = std::function<bool(const std::string&)>;

struct HttpAnswer {
  int status = 200;
  std::string type = "application/json";
  std::string body = {};
  std::vector<std::pair<std::string, std::string>> headers = {};
  /// Where it is set, the answer goes on: called again and again until it returns false.
  std::function<bool(const HttpSend&)> part = {};
};

/// In one line; names out of foreign files need not be UTF-8: what is not is replaced.
HttpAnswer json_answer(int status, const nlohmann::json& json);
/// {"error": word}
HttpAnswer refusal(int status, const std::string& word);
/// {"error": "field", "field": name}, 400: it is none of the call's, or holds something else.
HttpAnswer wrong_field(const std::string& name);

/// What a call's query may hold, and whether a value is one; an empty value is none.
using Parameters = std::map<std::string, bool (*)(const std::string&)>;
/// The first of a query that is none of them, or holds something else; "" if there is none.
std::string wrong_parameter(const HttpRequest& request, const Parameters& parameters);

struct HostAndPort {
  std::string host;  ///< "localhost", "::1"
  std::string port;  ///< empty: none is stated
};
/// Of "localhost:8080", "[::1]:8080", "[::1]".
HostAndPort host_and_port(const std::string& text);

/// Asked before the body is read; an answer there is the last word.
using HttpGate = std::function<std::optional<HttpAnswer>(const HttpRequest&)>;
using HttpHandler = std::function<HttpAnswer(const HttpRequest&)>;

/// What a client may ask of the server at most.
struct HttpLimits {
  std::size_t connections = 64;        ///< at a time; more are answered 503
  std::size_t body_bytes = 64 * 1024;  ///< more is answered 413
  std::size_t head_bytes = 32 * 1024;  ///< request line and headers; more ends the connection
  double request_s = 5;                ///< for the whole request, however slowly it drips
  double write_s = 5;                  ///< for what is sent at once to be taken
};

}  // namespace rvbench::bench
