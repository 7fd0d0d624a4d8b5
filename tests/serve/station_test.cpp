#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "bench/plan_files.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/serve/served_station.hpp"
#include "tests/spec/rvbench.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::HttpReply;
using test::last_event;
using test::longest_run;
using test::ScratchFolder;
using test::ServedStation;

nlohmann::json json_of(const HttpReply& reply) {
  return nlohmann::json::parse(reply.body, nullptr, false);
}

// Long enough to be killed in the middle of: each point is 16 s of the rig's time.
std::string long_plan(const ScratchFolder& scratch) {
  const auto quick = std::ranges::find(bench::plan_files(), "quick", &EmbeddedFile::name);
  auto plan = nlohmann::ordered_json::parse(quick->text);
  plan["setup"][1]["duration_s"] = 1;
  plan["main"][0]["repeats"] = 60;
  bench::write_file(scratch.path() / "long.json", plan.dump(2));
  return "\"plan\": \"long.json\"";
}

// A whole event that holds this.
auto tells(const std::string& word) {
  return [word](const std::string& stream) {
    const std::size_t at = stream.find(word);
    return at != std::string::npos && stream.find("\n\n", at) != std::string::npos;
  };
}
const auto has_ended = tells("\"phase\":\"ended\"");

nlohmann::json state_of(ServedStation& station) {
  const test::Socket socket = station.listen();
  return last_event(test::received(socket, tells("event: heartbeat")), "snapshot").at("state");
}

// A test of A17 that goes on, and what the station tells of it.
test::Socket started(ServedStation& station) {
  REQUIRE(station.log_in("otto").status == 200);
  REQUIRE(station.post("/api/scan", R"({"text":"A17"})").status == 200);
  REQUIRE(station.post("/api/start", R"({"serial":"A17"})").status == 202);
  return station.listen();
}

const std::string strict_limits =
    R"({"limits_version": "strict", "plan": "quick", "limits": [
        {"measure": "acceleration_peak", "unit": "g", "max": 0.0001, "why": "a test"}]})";

}  // namespace

TEST_CASE("a unit goes through the station: scan, start, watch, verdict, report, history",
          "[spec][serve]") {
  const ScratchFolder scratch;
  bench::write_file(scratch / "plan.json", test::quick_at_top_speed());
  ServedStation station(scratch, R"("plan": "plan.json", "serial": {"masks": ["A##"]})");
  REQUIRE(station.log_in("otto").status == 200);
  const test::Socket events = station.listen();
  CHECK(json_of(station.post("/api/start")).at("error") == "no_unit");
  CHECK(json_of(station.post("/api/scan", R"({"text":" \r\n"})")).at("error") == "empty");
  const HttpReply wrong = station.post("/api/scan", R"({"text":"B17"})");
  CHECK(wrong.status == 422);
  CHECK(json_of(wrong).at("error") == "serial_rule");

  const auto scanned = json_of(station.post("/api/scan", R"({"text":"A17\r\n"})"));
  CHECK(scanned.at("phase") == "ready");
  CHECK(scanned.at("serial") == "A17");
  CHECK(scanned.at("next_action") == "start");
  CHECK(scanned.at("station").at("name") == "EOL 3");
  CHECK(scanned.at("matrix").at("cells").size() == 2);
  // What is started is the unit that whoever starts it sees, not what somebody scanned meanwhile.
  CHECK(json_of(station.post("/api/start", R"({"serial":"A18"})")).at("error") == "other_unit");
  CHECK(json_of(station.post("/api/start")).at("error") == "other_unit");
  CHECK(station.post("/api/scan", R"({"text":"B17"})").status == 422);
  CHECK(json_of(station.post("/api/start", R"({"serial":"A17"})")).at("error") == "no_unit");
  REQUIRE(station.post("/api/scan", R"({"text":"A17"})").status == 200);
  REQUIRE(station.post("/api/start", R"({"serial":"A17"})").status == 202);
  CHECK(json_of(station.post("/api/start")).at("error") == "running");
  CHECK(json_of(station.post("/api/scan", R"({"text":"A18"})")).at("error") == "running");
  CHECK(station.post("/api/clear").status == 409);

  const std::string stream = test::received(events, has_ended, longest_run);
  CHECK_FALSE(last_event(stream, "snapshot").is_null());
  CHECK_FALSE(last_event(stream, "heartbeat").at("time_utc").get<std::string>().empty());
  const auto strip = last_event(stream, "strip");
  for (const char* key : {"t_s", "torque_Nm", "speed_rpm", "temperature_C", "vibration_g"}) {
    CAPTURE(key);
    CHECK(strip.at(key).is_number());
  }
  CHECK(last_event(stream, "spectrum").at("levels_dB").size() > 100);
  CHECK_THAT(stream, Contains("\"status\":\"measuring\""));
  const auto ended = last_event(stream, "state");
  for (const auto& cell : ended.at("matrix").at("cells")) CHECK(cell.at("status") == "done");
  const auto& verdict = ended.at("verdict");
  CHECK(verdict.at("word") == "PASS");
  CHECK(verdict.at("exit_code") == 0);
  CHECK(ended.at("next_action") == "read_verdict");

  // What the page links to is what the run left.
  const std::string run = verdict.at("run");
  const auto folder = scratch.path() / "runs" / run;
  CHECK(bench::verify_sums(folder).empty());
  const HttpReply report = station.get(verdict.at("report"));
  CHECK(report.status == 200);
  CHECK_THAT(report.head, Contains("default-src 'none'; style-src 'unsafe-inline'"));
  CHECK(report.body.find("A17") != std::string::npos);
  CHECK(json_of(station.get("/api/runs/" + run + "/verdict")).at("verdict") == "PASS");
  const auto history = json_of(station.get("/api/history?serial=A17"));
  CHECK(history.at("runs").at(0).at("folder") == run);
  CHECK(json_of(station.get("/api/history?serial=A18")).at("runs").empty());

  // Limits that no unit keeps to: what they would do is told, and a re-judgement that ends FAIL is
  // an answer.
  REQUIRE(station.log_in("anna").status == 200);
  CHECK(json_of(station.get("/api/limits")).at("versions").empty());
  CHECK(station.post("/api/limits/propose", R"({"limits": )" + strict_limits + "}").status == 200);
  const auto draft = json_of(station.get("/api/limits")).at("versions").at(0);
  CHECK(draft.at("status") == "draft");
  CHECK(draft.at("steps")[0].at("by") == "anna");
  const auto effect = json_of(station.get("/api/limits?version=strict")).at("effect");
  CHECK(effect.at("runs") == 1);
  CHECK(effect.at("changes").at(0).at("folder") == run);
  CHECK(effect.at("changes")[0].at("would_be") == "FAIL");
  const HttpReply unknown = station.get("/api/limits?version=lax");
  CHECK(unknown.status == 422);
  CHECK_THAT(unknown.body, Contains("no version"));
  CHECK(station.post("/api/limits/activate", R"({"version": "strict"})").status == 422);
  CHECK(station.post("/api/limits/approve", R"({"version": "strict"})").status == 200);
  const std::string again_by_strict = R"({"run": ")" + run + R"(", "limits": "strict"})";
  const HttpReply rejudged = station.post("/api/rejudge", again_by_strict);
  CHECK(rejudged.status == 200);
  const auto judgements = json_of(rejudged).at("runs").at(0);
  CHECK(judgements.at("as_judged").at("verdict") == "PASS");
  CHECK(judgements.at("rejudged").at("verdict") == "FAIL");
  CHECK(station.post("/api/rejudge", R"({"run": "A17/none"})").status == 422);
  CHECK(json_of(station.get("/api/trend?indicator=acceleration_peak")).at("values").size() > 0);
  REQUIRE(station.log_in("otto").status == 200);

  // The same unit again is asked about, and the next one is not.
  const auto again = json_of(station.post("/api/scan", R"({"text":"A17"})"));
  CHECK(again.at("phase") == "duplicate");
  CHECK(again.at("next_action") == "decide_retest");
  CHECK(again.at("known_runs").at(0).at("verdict") == "PASS");
  CHECK(json_of(station.post("/api/start")).at("error") == "duplicate");
  CHECK(json_of(station.post("/api/clear")).at("phase") == "idle");
  CHECK(json_of(station.post("/api/scan", R"({"text":"A18"})")).at("phase") == "ready");

  const auto audit = scratch.path() / "runs" / ".station" / "audit.jsonl";
  CHECK(test::rvbench(scratch.path(), {"check", audit.string()}).code == 0);
  std::string lines = bench::read_file(audit).value_or("");
  for (const char* act : {"login", "scan", "start", "refused start", "clear"}) {
    CHECK_THAT(lines, Contains("\"user\":\"otto\",\"address\":\"127.0.0.1\",\"action\":\"" +
                               std::string(act) + "\""));
  }
  CHECK_THAT(lines, !Contains(test::token_of("otto")));
  lines.replace(lines.find("\"otto\""), 6, "\"anna\"");
  bench::write_file(audit, lines);
  const auto tampered = test::rvbench(scratch.path(), {"check", audit.string()});
  CHECK(tampered.code == 3);
  CHECK_THAT(tampered.err, Contains("audit.jsonl:2: was changed"));
}

TEST_CASE("a station that is killed leaves the test running, and finds it again",
          "[spec][serve][safety]") {
  const ScratchFolder scratch;
  const std::string plan = long_plan(scratch);
  {
    ServedStation station(scratch, plan);
    const test::Socket events = started(station);
    const std::string stream = test::received(events, tells("\"status\":\"measuring\""));
    REQUIRE(last_event(stream, "strip").is_object());
    station.program().send(SIGKILL);
    CHECK(station.program().wait().code == -SIGKILL);
  }
  ServedStation station(scratch, plan);
  CHECK_THAT(station.program().said(), Contains("a test of A17 is running: found again"));
  CHECK(station.post("/api/stop").status == 401);  // a restart has logged everybody out
  REQUIRE(station.log_in("otto").status == 200);
  const test::Socket events = station.listen();
  const std::string alive = test::received(events, tells("event: strip"));
  CHECK_THAT(alive, Contains("\"phase\":\"running\""));
  CHECK_THAT(alive, Contains("event: strip"));

  REQUIRE(station.post("/api/stop").status == 202);
  const auto ended = last_event(test::received(events, has_ended, longest_run), "state");
  CHECK(ended.at("verdict").at("word") == "ABORTED");
  const auto folder = scratch.path() / "runs" / ended.at("verdict").at("run").get<std::string>();
  const auto judged =
      nlohmann::json::parse(bench::read_file(folder / "verdict.json").value_or("null"));
  CHECK(judged.at("run").at("shaft_stopped") == true);
  CHECK(judged.at("run").at("brake_released") == true);
  CHECK(station.post("/api/stop").status == 409);

  station.program().send(SIGTERM);
  const auto answer = station.program().wait();
  CHECK(answer.code == 0);
  CHECK_THAT(answer.err, Contains("rvbench: serve: ended\n"));
}

TEST_CASE("a test is stopped even where the station's log has been moved",
          "[spec][serve][safety]") {
  const ScratchFolder scratch;
  ServedStation station(scratch, long_plan(scratch));
  const test::Socket events = started(station);
  test::received(events, tells("\"status\":\"measuring\""));
  std::filesystem::rename(scratch.path() / "runs" / ".station" / "audit.jsonl",
                          scratch.path() / "moved.jsonl");
  CHECK(station.post("/api/stop").status == 202);
  const auto ended = last_event(test::received(events, has_ended, longest_run), "state");
  CHECK(ended.at("verdict").at("word") == "ABORTED");
}

TEST_CASE("a test that is stopped while it begins is no fault of the bench", "[spec][serve]") {
  const ScratchFolder scratch;
  ServedStation station(scratch, long_plan(scratch));
  REQUIRE(station.log_in("otto").status == 200);
  const test::Socket events = station.listen();
  REQUIRE(station.post("/api/scan", R"({"text":"A17"})").status == 200);
  REQUIRE(station.post("/api/start", R"({"serial":"A17","retest":false})").status == 202);
  const auto lock = scratch.path() / "runs" / ".station" / "run.lock";
  REQUIRE(test::wait_until([&] { return !bench::read_file(lock).value_or("").empty(); }));
  CHECK(station.post("/api/stop").status == 202);
  const auto ended = last_event(test::received(events, has_ended, longest_run), "state");
  CHECK(ended.at("verdict").at("word") == "ABORTED");
}

TEST_CASE("an answer that another unit's run left is no verdict of this one",
          "[spec][serve][safety]") {
  const ScratchFolder scratch;
  const auto keep = scratch.path() / "runs" / ".station";
  std::filesystem::create_directories(keep);
  // What power that fails right after A17 was started can leave of A16's run.
  bench::write_file(keep / "unit.json", R"({"serial": "A17", "newest_before": ""})");
  bench::write_file(keep / "answer.json", R"({"verdict": "PASS", "exit_code": 0, "reason": "",
      "run": {"serial": "A16", "started_utc": "20261127T101112Z"}})");
  ServedStation station(scratch, R"("plan": "quick")");
  REQUIRE(station.log_in("otto").status == 200);
  const auto state = state_of(station);
  CHECK(state.at("serial") == "A17");
  CHECK(state.at("verdict").at("word") == "ERROR");
  CHECK(state.at("verdict").at("exit_code") == 30);
  CHECK(state.at("verdict").at("code") == "other_run");
  CHECK_THAT(state.at("verdict").at("reason").get<std::string>(), Contains("of A16"));
}

TEST_CASE("SIGTERM ends the page and not the test, a test that is killed is an ERROR",
          "[spec][serve][safety]") {
  const ScratchFolder scratch;
  const std::string plan = long_plan(scratch);
  {
    ServedStation station(scratch, plan);
    const test::Socket events = started(station);
    (void)test::received(events, tells("event: strip"));
    station.program().send(SIGTERM);
    const auto answer = station.program().wait();
    CHECK(answer.code == 0);
    CHECK_THAT(answer.err, Contains("the test of A17 goes on"));
  }
  const auto lock = scratch.path() / "runs" / ".station" / "run.lock";
  const pid_t run = std::stoi(bench::read_file(lock).value_or("0"));
  REQUIRE(run > 1);
  REQUIRE(::kill(run, SIGKILL) == 0);
  ServedStation station(scratch, plan);
  REQUIRE(station.log_in("vera").status == 200);
  nlohmann::json state;
  CHECK(test::wait_until([&] {
    state = state_of(station);
    return state.at("phase") == "ended";
  }));
  CHECK(state.at("verdict").at("word") == "ERROR");
  CHECK(state.at("verdict").at("code") == "no_answer");
  CHECK_THAT(state.at("verdict").at("reason").get<std::string>(),
             Contains("ended without an answer") && Contains("watchdog"));
}

}  // namespace rvbench
