#include "bench/serve/station_file.hpp"

#include <catch2/catch.hpp>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

}  // namespace

TEST_CASE("a token opens with its own hash alone, and neither is kept with the other",
          "[bench][serve]") {
  const std::string token = make_token("anna");
  CHECK(user_of_token(token) == "anna");
  CHECK(token.size() == std::string("anna.").size() + 32);
  CHECK(make_token("anna") != token);
  CHECK(user_of_token("no dot").empty());
  const std::string hash = hash_of_token(token);
  CHECK_THAT(hash, Catch::StartsWith("$argon2id$v=19$"));
  CHECK(is_token_hash(hash));
  CHECK_FALSE(is_token_hash("$argon2id$"));
  CHECK_FALSE(is_token_hash(token));
  CHECK(matches(token, hash));
  CHECK_FALSE(matches(token + "0", hash));
  CHECK(are_same_secret("abc", "abc"));
  CHECK_FALSE(are_same_secret("abc", "abd"));
  CHECK_FALSE(are_same_secret("abc", "abcd"));
}

TEST_CASE("option --make-token prints a token and the entry that goes into a station file",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  const auto made = test::rvbench({"serve", "--make-token", "anna", "--role", "engineer"});
  REQUIRE(made.code == 0);
  const std::size_t entry = made.out.find("{\"name\"");
  REQUIRE(entry != std::string::npos);
  write_file(scratch / "station.json",
             R"({"station": "EOL 3", "plan": "quick", "rig": "sim", "runs": "units",
                 "serial": {"masks": ["A##"], "check_digit": "none"},
                 "users": [)" +
                 made.out.substr(entry) + "]}");
  const auto read = read_station(scratch / "station.json");
  REQUIRE(read.index() == 0);
  const auto& station = std::get<0>(read);
  CHECK(station.name == "EOL 3");
  CHECK(station.runs == scratch / "units");  // as seen from the file
  CHECK(station.serial.masks == std::vector<std::string>{"A##"});
  CHECK(station.users.at(0).role == Role::engineer);
  CHECK_FALSE(station.remote_start);
  CHECK(station.bind == "127.0.0.1");
  CHECK(test::rvbench({"check", (scratch / "station.json").string()}).code == 0);

  CHECK(test::rvbench({"serve", "--make-token", "no one"}).code == 2);
  CHECK(test::rvbench({"serve", "--make-token", "anna", "--role", "boss"}).code == 2);
}

TEST_CASE("every fault of a station file is told at once, with line and pointer",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch / "station.json", R"({
  "station": "EOL 3",
  "plan": "quik",
  "rig": "none.json",
  "serial": {"check_digit": "mod12"},
  "users": [
    {"name": "anna", "role": "boss", "token_hash": "secret"},
    {"name": "anna", "role": "viewer", "token_hash": "$argon2id$"},
    {"name": "a b", "role": "viewer", "token_hash": "x"}
  ],
  "bind": "0.0.0.0",
  "remote_strt": true
}
)");
  const auto answer = test::rvbench({"check", (scratch / "station.json").string()});
  CHECK(answer.code == 3);
  for (const char* fault :
       {"station.json:3: /plan: ", "station.json:4: /rig: ",
        "station.json:5: /serial/check_digit: expected one of",
        "station.json:7: /users/0/role: expected one of", "station.json:7: /users/0/token_hash: ",
        "station.json:8: /users/1/name: there is a user \"anna\" already",
        "station.json:9: /users/2/name: expected", "station.json:11: /bind: others reach",
        "station.json:12: /remote_strt: unknown key, did you mean \"remote_start\"?"}) {
    CHECK_THAT(answer.err, Contains(fault));
  }
}

TEST_CASE("a rule that lets no golden unit in is a fault, by its mask and by its check digit",
          "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch / "rig.json", R"({"rig": "sim", "qualification": {
    "station": "EOL 3", "golden_unit": {"serial": "GOLDEN", "plan": "quick"}}})");
  const auto told = [&](const std::string& rule) {
    write_file(scratch / "station.json",
               R"({"station": "EOL 3", "plan": "quick", "rig": "rig.json", "users": [],
"serial": )" + rule +
                   "}");
    return test::rvbench({"check", (scratch / "station.json").string()}).err;
  };
  CHECK_THAT(told(R"({"masks": ["A##"]})"),
             Contains("station.json:2: /serial: refuses \"GOLDEN\", the golden unit of ") &&
                 Contains("fits none of the masks: it could never be scanned"));
  CHECK_THAT(told(R"({"check_digit": "mod10"})"), Contains("by its check digit"));
  CHECK_THAT(told(R"({"masks": ["A##", "GOLDEN"]})"), !Contains("/serial"));
}

TEST_CASE("a station that nobody could use is refused", "[bench][serve]") {
  const rvbench::test::ScratchFolder scratch;
  write_file(scratch / "station.json",
             R"({"station": "EOL 3", "plan": "quick", "rig": "sim", "users": []})");
  const auto answer = test::rvbench({"serve", "--station", (scratch / "station.json").string()});
  CHECK(answer.code == 3);
  CHECK_THAT(answer.err, Contains("/users: nobody could log in") && Contains("--make-token"));
  CHECK(test::rvbench({"serve", "--station", (scratch / "none.json").string()}).code == 3);
  const auto open = test::rvbench({"serve", "--bind", "0.0.0.0", "--port", "0"});
  CHECK(open.code == 2);
  CHECK_THAT(open.err, Contains("--bind 0.0.0.0") && Contains("\"hosts\""));
}

}  // namespace rvbench::bench
