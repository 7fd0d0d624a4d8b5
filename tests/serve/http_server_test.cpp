#include "bench/serve/http_server.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "tests/support/http_client.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ask_server;
using rvbench::test::connected_to;
using rvbench::test::http_request;
using rvbench::test::HttpReply;
using rvbench::test::received;
using rvbench::test::send_all;

// Answers with what it was asked, on a port of its own.
class EchoServer {
 public:
  explicit EchoServer(HttpLimits limits = {})
      : server_(
            limits, [](const HttpRequest&) { return std::optional<HttpAnswer>(); },
            [this](const HttpRequest& request) {
              if (request.path == "/throws") throw std::runtime_error("a secret of the house");
              if (request.path == "/endless") {
                return HttpAnswer{.part = [this](const HttpSend& send) {
                  const bool is_taken = send(std::string(100'000, 'x'));
                  if (!is_taken) has_hung_up_ = true;
                  return is_taken;
                }};
              }
              return HttpAnswer{.body = request.method + " " + request.path + " " + request.body};
            }),
        port_(static_cast<std::uint16_t>(server_.bind("127.0.0.1", 0))),
        thread_([this] { server_.serve(); }) {}
  ~EchoServer() {
    server_.stop();
    thread_.join();
  }
  EchoServer(const EchoServer&) = delete;
  EchoServer& operator=(const EchoServer&) = delete;
  std::uint16_t port() const { return port_; }
  bool has_hung_up() const { return has_hung_up_; }  ///< on who listens at "/endless"

 private:
  std::atomic<bool> has_hung_up_ = false;
  HttpServer server_;
  std::uint16_t port_;
  std::thread thread_;
};

}  // namespace

TEST_CASE("a server answers what is asked in due form, with the headers that keep a page its own",
          "[bench][serve]") {
  const EchoServer server;
  const HttpReply read =
      ask_server(server.port(), http_request("GET", "/a%20b?x=1", server.port()));
  CHECK(read.status == 200);
  CHECK(read.body == "GET /a b ");
  for (const char* header :
       {"Content-Security-Policy: default-src 'self'", "X-Content-Type-Options: nosniff",
        "X-Frame-Options: DENY", "Cache-Control: no-store", "Connection: close"}) {
    CHECK_THAT(read.head, Contains(header));
  }
  const HttpReply posted =
      ask_server(server.port(), http_request("POST", "/x", server.port(), {}, "{}"));
  CHECK(posted.body == "POST /x {}");
}

TEST_CASE("what no client of ours sends is refused", "[bench][serve]") {
  const EchoServer server({.body_bytes = 1000});
  const auto status_of = [&](const std::string& method, const std::string& target,
                             const rvbench::test::HttpHeaders& headers,
                             const std::string& body = "") {
    return ask_server(server.port(), http_request(method, target, server.port(), headers, body))
        .status;
  };
  CHECK(status_of("DELETE", "/", {}) == 405);
  CHECK(status_of("GET", "/" + std::string(2000, 'a'), {}) == 414);
  CHECK(status_of("GET", "/", {{"Range", "bytes=0-,0-,0-"}}) == 416);
  CHECK(status_of("POST", "/", {{"Content-Type", "text/plain"}}, "{}") == 415);
  CHECK(status_of("POST", "/", {{"Content-Encoding", "gzip"}}, "{}") == 415);
  CHECK(status_of("POST", "/", {{"Content-Length", ""}}) == 411);
  CHECK(status_of("POST", "/", {{"Transfer-Encoding", "chunked"}}, "2\r\n{}\r\n0\r\n\r\n") == 411);
  CHECK(status_of("POST", "/", {}, std::string(1001, ' ')) == 413);
  CHECK(status_of("POST", "/", {{"Content-Length", "99999999999999999999999"}}) == 413);
  for (const char* method : {"POST", "GET"}) {
    CHECK(status_of(method, "/", {{"Content-Length", "-5"}}) == 400);
    CHECK(status_of(method, "/", {{"Content-Length", "abc"}}) == 400);
  }
  CHECK(status_of("GET", "/", {{"Host", "a\r\nHost: b"}}) == 400);
  CHECK(status_of("POST", "/", {}, std::string(1000, ' ')) == 200);
  // More of a head than a head can have: no answer is owed.
  CHECK(status_of("GET", "/", {{"X", std::string(100'000, 'x')}}) != 200);
  CHECK(ask_server(server.port(), "nonsense\r\n\r\n").status != 200);
  CHECK(ask_server(server.port(), std::string(1000, '\0')).status != 200);
  CHECK(status_of("GET", "/", {}) == 200);  // and it still answers
}

TEST_CASE("what goes wrong inside is told to nobody outside", "[bench][serve]") {
  const EchoServer server;
  const HttpReply reply = ask_server(server.port(), http_request("GET", "/throws", server.port()));
  CHECK(reply.status == 500);
  CHECK_FALSE(reply.holds("secret"));
  CHECK_THAT(reply.head, !Contains("secret"));
}

TEST_CASE("a slow client is hung up on, however it drips, and holds up nobody", "[bench][serve]") {
  const EchoServer server({.request_s = 0.3, .write_s = 0.3});
  const auto began = std::chrono::steady_clock::now();
  const auto silent = connected_to(server.port());
  const auto dripping = connected_to(server.port());
  const auto half = connected_to(server.port());
  REQUIRE(send_all(dripping, "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n"));
  REQUIRE(
      send_all(half, http_request("POST", "/", server.port(), {{"Content-Length", "10"}}, "{")));
  CHECK(ask_server(server.port(), http_request("GET", "/", server.port())).status == 200);
  int drops = 0;
  while (drops < 1000 && send_all(dripping, "X: y\r\n")) {
    ++drops;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  CHECK(drops < 1000);  // the other end is gone
  const auto never = [](const std::string&) { return false; };
  CHECK_THAT(received(silent, never), !Contains(" 200 "));
  CHECK_THAT(received(half, never), !Contains(" 200 "));
  CHECK(std::chrono::steady_clock::now() - began < rvbench::test::patience);
}

TEST_CASE("a listener that takes nothing is hung up on", "[bench][serve]") {
  const EchoServer server({.request_s = 0.3, .write_s = 0.3});
  const auto lazy = connected_to(server.port());
  REQUIRE(send_all(lazy, http_request("GET", "/endless", server.port())));
  CHECK(rvbench::test::wait_until([&] { return server.has_hung_up(); }));
  // What fitted into the line is all there is: the end comes although nobody stops the server.
  const auto endless = [](const std::string& text) { return text.size() > 100'000'000; };
  CHECK(received(lazy, endless).size() < 100'000'000);
}

TEST_CASE("beyond so many connections the answer is 503, at once", "[bench][serve]") {
  const EchoServer server({.connections = 2, .request_s = 60});
  const auto first = connected_to(server.port());
  const auto second = connected_to(server.port());
  std::string answer;
  CHECK(rvbench::test::wait_until([&] {
    const auto third = connected_to(server.port());
    answer = received(
        third, [](const std::string& text) { return text.ends_with("\r\n\r\n"); },
        std::chrono::milliseconds(200));
    return !answer.empty();
  }));
  CHECK_THAT(answer, Catch::StartsWith("HTTP/1.1 503 "));
}

}  // namespace rvbench::bench
