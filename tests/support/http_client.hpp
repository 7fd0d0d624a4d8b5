#pragma once

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "tests/support/loopback.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench::test {

/// What a server on this computer has answered.
struct HttpReply {
  int status = 0;  ///< 0: it hung up without a word
  std::string head, body;

  bool holds(const std::string& text) const { return body.find(text) != std::string::npos; }
};

using HttpHeaders = std::map<std::string, std::string>;

/// The bytes of a request, as a browser would send it.
inline std::string http_request(const std::string& method, const std::string& target,
                                std::uint16_t port, const HttpHeaders& headers = {},
                                const std::string& body = "") {
  HttpHeaders all{{"Host", "127.0.0.1:" + std::to_string(port)}};
  if (method == "POST") {
    all["Content-Type"] = "application/json";
    all["Content-Length"] = std::to_string(body.size());
  }
  for (const auto& [name, value] : headers) all[name] = value;
  std::string text = method + " " + target + " HTTP/1.1\r\n";
  for (const auto& [name, value] : all) {
    if (!value.empty()) text += name + ": " + value + "\r\n";
  }
  return text + "\r\n" + body;
}

inline bool send_all(const Socket& socket, const std::string& text) {
  return ::send(socket.number(), text.data(), text.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(text.size());
}

/// What has come within that time, at the most until `enough` says so or the other end hangs up.
template <typename Enough>
std::string received(const Socket& socket, Enough enough,
                     std::chrono::duration<double> limit = patience) {
  const auto end = std::chrono::steady_clock::now() + limit;
  std::string text;
  std::array<char, 65536> buffer{};
  while (!enough(text) && std::chrono::steady_clock::now() < end) {
    pollfd wanted{socket.number(), POLLIN, 0};
    if (::poll(&wanted, 1, 50) <= 0) continue;
    const ssize_t got = ::recv(socket.number(), buffer.data(), buffer.size(), 0);
    if (got <= 0) break;
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  return text;
}

inline HttpReply parsed_reply(const std::string& text) {
  HttpReply reply;
  if (text.size() > 12 && text.starts_with("HTTP/1.1 "))
    reply.status = std::stoi(text.substr(9, 3));
  const std::size_t gap = text.find("\r\n\r\n");
  reply.head = text.substr(0, gap);
  if (gap != std::string::npos) reply.body = text.substr(gap + 4);
  return reply;
}

/// Sends these bytes on a connection of their own, and waits for the other end to hang up.
inline HttpReply ask_server(std::uint16_t port, const std::string& request) {
  const Socket socket = connected_to(port);
  (void)send_all(socket, request);
  // A judgement is an answer, too, which takes a sanitized program some ten seconds.
  const std::chrono::minutes limit(1);
  return parsed_reply(received(socket, [](const std::string&) { return false; }, limit));
}

}  // namespace rvbench::test
