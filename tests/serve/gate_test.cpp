#include "bench/serve/gate.hpp"

#include <catch2/catch.hpp>

#include "bench/serve/attempts.hpp"
#include "bench/serve/station_api.hpp"

namespace rvbench::bench {
namespace {

std::string word_of(const std::optional<HttpAnswer>& answer) {
  return answer ? std::to_string(answer->status) + " " + answer->body : "";
}

HttpRequest get(const std::string& path) { return {"GET", path, {{"host", "127.0.0.1:8080"}}}; }

}  // namespace

TEST_CASE("the gate lets in who is logged in and asks from the page, and nobody else",
          "[bench][serve]") {
  Sessions sessions;
  const Gate gate({"localhost", "127.0.0.1", "[::1]", "EOL3.factory.local:443"}, 8080, sessions);
  const std::string cookie = sessions.begin("anna", Role::operating);
  const std::string csrf = sessions.find(cookie)->csrf;
  HttpRequest request = get("/api/session");
  request.headers["cookie"] = "other=1; rvbench_session=" + cookie;

  SECTION("a session, for reading") { CHECK_FALSE(gate.refused(request)); }
  SECTION("no session") {
    request.headers.erase("cookie");
    CHECK(word_of(gate.refused(request)) == "401 {\"error\":\"login\"}\n");
    request.headers["cookie"] = "rvbench_session=" + std::string(64, '0');
    CHECK(word_of(gate.refused(request)) == "401 {\"error\":\"login\"}\n");
    CHECK_FALSE(gate.refused(get("/")));  // the page itself shows who must log in
    CHECK_FALSE(gate.refused({"POST", "/api/login", {{"host", "localhost:8080"}}}));
  }
  SECTION("hosts that are the station, and hosts that are not") {
    for (const char* host :
         {"localhost:8080", "LOCALHOST:8080", "[::1]:8080", "eol3.factory.local:443"}) {
      request.headers["host"] = host;
      CHECK_FALSE(gate.refused(request));
    }
    for (const char* host : {"", "127.0.0.1", "127.0.0.1:8081", "evil.example:8080",
                             "localhost.evil.example:8080", "eol3.factory.local"}) {
      request.headers["host"] = host;
      CAPTURE(host);
      CHECK(word_of(gate.refused(request)) == "403 {\"error\":\"host\"}\n");
    }
  }
  SECTION("origins") {
    request.headers["origin"] = "http://127.0.0.1:8080";
    CHECK_FALSE(gate.refused(request));
    for (const char* origin : {"null", "http://127.0.0.1", "http://evil.example",
                               "http://localhost:8080", "ftp://127.0.0.1:8080"}) {
      request.headers["origin"] = origin;
      CAPTURE(origin);
      CHECK(word_of(gate.refused(request)) == "403 {\"error\":\"origin\"}\n");
    }
    request.headers.erase("origin");
    request.headers["sec-fetch-site"] = "cross-site";
    CHECK(word_of(gate.refused(request)) == "403 {\"error\":\"origin\"}\n");
    request.headers["sec-fetch-site"] = "same-origin";
    CHECK_FALSE(gate.refused(request));
  }
  SECTION("what changes something carries the session's word") {
    request.method = "POST";
    request.path = "/api/start";
    CHECK(word_of(gate.refused(request)) == "403 {\"error\":\"csrf\"}\n");
    request.headers["x-csrf-token"] = std::string(csrf.size(), '0');
    CHECK(word_of(gate.refused(request)) == "403 {\"error\":\"csrf\"}\n");
    const std::string other = sessions.begin("otto", Role::engineer);
    request.headers["x-csrf-token"] = sessions.find(other)->csrf;
    CHECK(word_of(gate.refused(request)) == "403 {\"error\":\"csrf\"}\n");
    request.headers["x-csrf-token"] = csrf;
    CHECK_FALSE(gate.refused(request));
  }
  SECTION("who has logged out is out") {
    sessions.end(cookie);
    CHECK(word_of(gate.refused(request)) == "401 {\"error\":\"login\"}\n");
  }
}

TEST_CASE("a session ends with the shift, and the oldest where there are too many",
          "[bench][serve]") {
  double now_s = 0;
  Sessions sessions([&now_s] { return now_s; });
  const std::string first = sessions.begin("anna", Role::viewer);
  now_s = Sessions::longest_s - 1;
  CHECK(sessions.find(first)->user == "anna");
  const std::string second = sessions.begin("otto", Role::viewer);
  now_s = Sessions::longest_s + 1;
  CHECK_FALSE(sessions.find(first));
  CHECK(sessions.find(second));
  for (std::size_t i = 0; i < Sessions::most; ++i) {
    now_s += 1;
    (void)sessions.begin("many", Role::viewer);
  }
  CHECK_FALSE(sessions.find(second));
}

TEST_CASE("who fails too often waits, and nobody else does", "[bench][serve]") {
  double now_s = 0;
  FailedAttempts attempts(3, [&now_s] { return now_s; });
  for (int i = 0; i < 3; ++i) {
    CHECK_FALSE(attempts.must_wait("anna"));
    attempts.add("anna");
    now_s += 0.1;
  }
  CHECK(attempts.must_wait("anna"));
  CHECK_FALSE(attempts.must_wait("otto"));
  now_s += FailedAttempts::apart_s;  // one more is let in, and counts
  CHECK_FALSE(attempts.must_wait("anna"));
  attempts.add("anna");
  CHECK(attempts.must_wait("anna"));
  now_s += FailedAttempts::remembered_s + 1;
  attempts.add("anna");  // the others are forgotten
  CHECK_FALSE(attempts.must_wait("anna"));
}

TEST_CASE("a host is told from its port, also where it is an address with colons",
          "[bench][serve]") {
  CHECK(host_and_port("localhost:8080").host == "localhost");
  CHECK(host_and_port("localhost:8080").port == "8080");
  CHECK(host_and_port("bench").port.empty());
  CHECK(host_and_port("[::1]:8080").host == "::1");
  CHECK(host_and_port("[::1]:8080").port == "8080");
  CHECK(host_and_port("[::1]").host == "::1");
  CHECK(host_and_port("[::1]").port.empty());
}

TEST_CASE("a cookie is found among others, whole or not at all", "[bench][serve]") {
  CHECK(cookie_in("a=1; b=2", "b") == "2");
  CHECK(cookie_in("a=1;b=2;", "b") == "2");
  CHECK(cookie_in("bb=1; b=", "b").empty());
  CHECK(cookie_in("ab=1", "b").empty());
  CHECK(cookie_in("", "b").empty());
  CHECK(cookie_in(" ; ;", "b").empty());
}

TEST_CASE("who comes through a proxy that hands on who asks, or by what name, comes from afar",
          "[bench][serve]") {
  HttpRequest request{.method = "POST", .path = "/api/start", .address = "127.0.0.1"};
  for (const char* host : {"localhost:8080", "127.0.0.1:8080", "[::1]:8080"}) {
    request.headers = {{"host", host}};
    CHECK_FALSE(is_from_afar(request));
  }
  for (const char* host :
       {"eol3.factory.local", "eol3.factory.local:443", "192.168.3.30:8080", ""}) {
    request.headers = {{"host", host}};
    CAPTURE(host);
    CHECK(is_from_afar(request));
  }
  request.headers = {{"host", "localhost:8080"}, {"x-forwarded-for", "192.168.3.30"}};
  CHECK(is_from_afar(request));
  request.headers = {{"host", "localhost:8080"}};
  request.address = "192.168.3.30";
  CHECK(is_from_afar(request));
}

}  // namespace rvbench::bench
