#include <signal.h>

#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "bench/text_file.hpp"
#include "tests/serve/served_station.hpp"
#include "tests/spec/rvbench.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::HttpReply;
using test::ScratchFolder;
using test::ServedStation;

std::string word_of(const HttpReply& reply) {
  const auto json = nlohmann::json::parse(reply.body, nullptr, false);
  return std::to_string(reply.status) + " " +
         (json.is_object() ? json.value("error", "") : std::string("?"));
}

}  // namespace

TEST_CASE("a station refuses who is not logged in, asks from elsewhere, or asks too much",
          "[spec][serve]") {
  const ScratchFolder scratch;
  ServedStation station(scratch, R"("plan": "quick")");
  const auto origin = [&](const std::string& of) { return test::HttpHeaders{{"Origin", of}}; };

  SECTION("login") {
    for (const char* call : {"/api/session", "/api/events", "/api/history", "/api/audit",
                             "/api/runs/A17/20260102T030405Z/report", "/api/none"}) {
      CAPTURE(call);
      CHECK(word_of(station.get(call)) == "401 login");
    }
    CHECK(word_of(station.post("/api/start")) == "401 login");
    CHECK(word_of(station.post("/api/login", R"({"token":"otto.0"})")) == "401 bad_token");
    CHECK(word_of(station.post("/api/login", R"({"token":"nobody.0"})")) == "401 bad_token");
    CHECK(word_of(station.post("/api/login", R"({"token":17})")) == "400 malformed");
    const HttpReply reply = station.log_in("otto");
    CHECK(nlohmann::json::parse(reply.body).at("role") == "operator");
    CHECK_THAT(reply.head, Contains("; HttpOnly; SameSite=Strict"));
    CHECK(station.get("/api/session").status == 200);
    CHECK(station.post("/api/logout").status == 200);
    CHECK(word_of(station.get("/api/session")) == "401 login");
  }
  SECTION("guessing: five times, then once a second, which holds up nobody who was in before") {
    REQUIRE(station.log_in("otto").status == 200);
    int let_in = 0;
    for (int i = 0; i < 40; ++i) {
      const std::string word = word_of(station.post("/api/login", R"({"token":"otto.0"})"));
      let_in += word == "401 bad_token" ? 1 : 0;
      if (i == 5) CHECK(word == "429 too_many_attempts");
    }
    CHECK(let_in < 30);
    CHECK(station.log_in("otto").status == 200);
    CHECK(station.log_in("anna").status == 200);
  }
  SECTION("roles") {
    REQUIRE(station.log_in("vera").status == 200);
    CHECK(word_of(station.post("/api/scan", R"({"text":"A17"})")) == "403 role");
    CHECK(word_of(station.post("/api/start")) == "403 role");
    CHECK(station.get("/api/history").status == 200);
    REQUIRE(station.log_in("otto").status == 200);
    CHECK(word_of(station.post("/api/limits/approve", R"({"version":"1"})")) == "403 role");
    CHECK(word_of(station.get("/api/audit")) == "403 role");
    REQUIRE(station.log_in("anna").status == 200);
    const auto entries = nlohmann::json::parse(station.get("/api/audit?last=3").body)["entries"];
    REQUIRE(entries.size() == 3);
    CHECK(entries.back().at("user") == "anna");
    CHECK(entries[1].at("action") == "refused limits/approve");
  }
  SECTION("CSRF") {
    REQUIRE(station.log_in("otto").status == 200);
    const std::string scan = R"({"text":"A17"})";
    CHECK(word_of(station.post("/api/scan", scan, {{"X-CSRF-Token", ""}})) == "403 csrf");
    CHECK(word_of(station.post("/api/scan", scan, {{"X-CSRF-Token", "0"}})) == "403 csrf");
    CHECK(word_of(station.post("/api/scan", scan, {{"Content-Type", "text/plain"}})) ==
          "415 expected_json");
    CHECK(station.post("/api/scan", scan).status == 200);
  }
  SECTION("Host and Origin") {
    REQUIRE(station.log_in("otto").status == 200);
    const std::string port = std::to_string(station.port());
    CHECK(word_of(station.post("/api/stop", "{}", {{"Host", "evil.example:" + port}})) ==
          "403 host");
    CHECK(word_of(station.post("/api/stop", "{}", origin("http://evil.example"))) == "403 origin");
    CHECK(word_of(station.post("/api/stop", "{}", origin("null"))) == "403 origin");
    CHECK(word_of(station.post("/api/stop", "{}", origin("http://127.0.0.1:" + port))) ==
          "409 not_running");
  }
  SECTION("another computer, which a proxy speaks for") {
    REQUIRE(station.log_in("otto").status == 200);
    REQUIRE(station.post("/api/scan", R"({"text":"A17"})").status == 200);
    CHECK(word_of(station.post("/api/start", "{}", {{"X-Forwarded-For", "192.168.3.30"}})) ==
          "409 remote_start_off");
  }
  SECTION("paths that lead elsewhere") {
    REQUIRE(station.log_in("anna").status == 200);
    bench::write_file(scratch.path() / "runs" / "verdict.json", "{}");
    bench::write_file(scratch.path() / "verdict.json", "{}");
    std::filesystem::create_directories(scratch.path() / "runs" / "A17");
    std::filesystem::create_symlink(scratch.path(), scratch.path() / "runs" / "A17" / "link");
    for (const char* target :
         {"/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/js/../../station.json",
          "/api/runs/../verdict", "/api/runs/%2e%2e/%2e%2e/verdict", "/api/runs/A17/../verdict",
          "/api/runs/A17/link/verdict", "/api/runs/..%2f..%2f/x/verdict", "/api/runs//A17/verdict",
          "/api/runs/.station/x/verdict", "/api/runs/A17/x%00/verdict",
          "/api/runs/A17/x/audit.jsonl", "/api/runs/A17", "/etc/passwd", "/index.html%00.js"}) {
      CAPTURE(target);
      CHECK(word_of(station.get(target)) == "404 not_found");
    }
    CHECK(station.get("/").status == 200);
    CHECK_THAT(station.get("/").head, Contains("text/html"));
    CHECK(word_of(station.post("/")) == "405 method");
  }
  SECTION("bodies too large, and bodies that are no JSON") {
    REQUIRE(station.log_in("otto").status == 200);
    CHECK(word_of(station.post("/api/scan", std::string(70'000, ' '))) == "413 body_too_large");
    for (const std::string& body : {std::string("{"), std::string("[]"), std::string("17"),
                                    std::string("{\"text\":\"\xff\"}"), std::string(60'000, '['),
                                    std::string("{\"text\":\"A17\"}}"), std::string(10, '\0'),
                                    std::string("{\"text\":\"A1\",\"text\":\"A2\"}")}) {
      CAPTURE(body.substr(0, 20));
      CHECK(word_of(station.post("/api/scan", body)) == "400 malformed");
    }
    CHECK(word_of(station.post("/api/scan", R"({"text":{"a":[1]}})")) == "400 field");
    CHECK(station.get("/api/session").status == 200);
  }
  SECTION("fields that a call does not know, or that hold something else, are named") {
    REQUIRE(station.log_in("anna").status == 200);
    const auto refused = [&](const char* call, const char* body) {
      const HttpReply reply = station.post(call, body);
      CHECK(reply.status == 400);
      return nlohmann::json::parse(reply.body).value("field", "");
    };
    CHECK(refused("/api/start", R"({"serial":"A17","retest":"yes"})") == "retest");
    CHECK(refused("/api/stop", R"({"now":true})") == "now");
    CHECK(refused("/api/limits/propose", R"({"version":"1","per_point":"yes"})") == "per_point");
    CHECK(refused("/api/limits/approve", R"({"version":true})") == "version");
    CHECK(refused("/api/rejudge", R"({"run":"A17/1","version":"1"})") == "version");
    CHECK(refused("/api/limits/propose", R"({"version":"1","limits":{}})") == "version");
    for (const auto& [query, field] :
         std::map<std::string, std::string>{{"history?last=nan", "last"},
                                            {"history?last=0", "last"},
                                            {"history?from=yesterday", "from"},
                                            {"history?to=2026-13-01", "to"},
                                            {"history?verdict=good", "verdict"},
                                            {"trend?indicator=kurtosis&last=-1", "last"},
                                            {"trend?indicator=kurtosis&point=nan/50", "point"},
                                            {"history?seral=A17", "seral"},
                                            {"trend?indicator=kurtosis&json=1", "json"},
                                            {"trend?last=5", "indicator"},
                                            {"audit?last=nan", "last"},
                                            {"audit?from=2026-11-21", "from"},
                                            {"limits?verion=2026-11", "verion"},
                                            {"limits?version=--yes", "version"},
                                            {"history?serial=A17%00zzz", "serial"},
                                            {"history?last=1&last=2", "last"}}) {
      CAPTURE(query);
      const HttpReply reply = station.get("/api/" + query);
      CHECK(reply.status == 400);
      CHECK(nlohmann::json::parse(reply.body).value("field", "") == field);
    }
    CHECK(station.get("/api/history?from=2026-11-21&verdict=PASS&last=5&serial=").status == 200);
  }
  SECTION("a second station on the same runs") {
    const auto second = test::rvbench(scratch.path(), {"serve", "--station", "station.json"});
    CHECK(second.code == 2);
    CHECK_THAT(second.err, Contains("another rvbench serves"));
  }
}

TEST_CASE("a station whose log is moved does nothing, and says so where it begins another",
          "[spec][serve]") {
  const ScratchFolder scratch;
  const auto log = scratch.path() / "runs" / ".station" / "audit.jsonl";
  const auto first_of_log = [&log] {
    const std::string text = bench::read_file(log).value_or("");
    return nlohmann::json::parse(text.substr(0, text.find('\n')), nullptr, false);
  };
  {
    ServedStation station(scratch, R"("plan": "quick")");
    CHECK_THAT(station.program().said(), !Contains("warning"));
    CHECK(first_of_log().at("action") == "begun");
    CHECK_FALSE(first_of_log().contains("detail"));
    REQUIRE(station.log_in("otto").status == 200);
    std::filesystem::rename(log, scratch.path() / "moved.jsonl");
    const HttpReply scan = station.post("/api/scan", R"({"text":"A17"})");
    CHECK(word_of(scan) == "503 audit");
    CHECK_THAT(scan.body, Contains("audit.jsonl is gone, or another file stands in its place"));
    CHECK(word_of(station.post("/api/start", R"({"serial":"A17"})")) == "503 audit");
    CHECK(word_of(station.post("/api/stop", "{}")) == "409 not_running");  // whatever the log
    CHECK(word_of(station.log_in("anna")) == "503 audit");
    station.program().send(SIGTERM);
    CHECK(station.program().wait().code == 0);
  }
  CHECK_FALSE(std::filesystem::exists(log));
  ServedStation station(scratch, R"("plan": "quick")");
  CHECK_THAT(station.program().said(), Contains("warning: ") && Contains("its log is gone"));
  CHECK(first_of_log().at("detail") == "the station was served before, its log is gone");
  REQUIRE(station.log_in("otto").status == 200);
  CHECK(station.post("/api/scan", R"({"text":"A17"})").status == 200);
}

TEST_CASE("limits are learnt through the station, or refused with the reason", "[spec][serve]") {
  const ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path() / "runs");
  ServedStation station(scratch, R"("plan": "quick")");
  REQUIRE(station.log_in("anna").status == 200);
  const HttpReply none =
      station.post("/api/limits/propose", R"({"version": "v1", "plan": "quick"})");
  CHECK(none.status == 422);
  CHECK_THAT(none.body, Contains("nothing could be learnt, so there is no draft: "));
  CHECK(station.post("/api/limits/propose", R"({"version": "v1"})").body == none.body);
  CHECK(word_of(station.post("/api/limits/propose", R"({"plan": "quick"})")) == "400 field");
  CHECK(word_of(station.post("/api/limits/propose", R"({"version": "v1", "plan": "--yes"})")) ==
        "400 field");
}

}  // namespace rvbench
