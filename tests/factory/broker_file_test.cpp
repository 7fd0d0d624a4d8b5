#include "bench/factory/broker_file.hpp"

#include <catch2/catch.hpp>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using rvbench::test::ScratchFolder;

namespace {

std::string written(const ScratchFolder& folder, const std::string& text) {
  write_file(folder / "mqtt.json", text);
  return (folder / "mqtt.json").string();
}

Broker good(const std::string& file) {
  const auto broker = read_broker(file);
  REQUIRE(broker.index() == 0);
  return std::get<0>(broker);
}

std::string faults_of(const std::string& file) {
  const auto broker = read_broker(file);
  REQUIRE(broker.index() == 1);
  std::string text;
  for (const auto& fault : std::get<1>(broker)) text += hal::describe("mqtt.json", fault) + "\n";
  return text;
}

void write_password(const ScratchFolder& folder, const std::string& text, bool for_all) {
  write_file(folder / "password", text);
  using std::filesystem::perms;
  std::filesystem::permissions(folder / "password",
                               perms::owner_read | (for_all ? perms::others_read : perms::none));
}

}  // namespace

TEST_CASE("a broker file needs a host, the rest has defaults", "[factory][broker]") {
  const ScratchFolder folder;
  const Broker broker = good(written(folder, R"({"host": "::1", "station_name": "b3"})"));
  CHECK(broker.port == 1883);
  CHECK(broker.ca.empty());
  CHECK(broker.qos == 1);
  CHECK(broker.client_id == "rvbench-b3");
  CHECK(broker.topic == "rvbench/b3/result");
  CHECK(broker.status_topic() == "rvbench/b3/status");
  CHECK(remarks_on(broker).empty());
}

TEST_CASE("paths in a broker file are seen from its folder, and TLS has a port of its own",
          "[factory][broker]") {
  const ScratchFolder folder;
  write_file(folder / "ca.pem", "-----BEGIN CERTIFICATE-----");
  write_password(folder, "secret\n", false);
  const Broker broker = good(written(folder, R"({"host": "h", "tls": {"ca": "ca.pem"},
      "user": "u", "password_file": "password", "topic": "plant/eol/rv/results", "qos": 2})"));
  CHECK(broker.ca == (folder / "ca.pem").string());
  CHECK(broker.password == "secret");
  CHECK(broker.port == 8883);
  CHECK(broker.status_topic() == "plant/eol/rv/status");
  CHECK(remarks_on(broker).empty());
}

TEST_CASE("every fault of a broker file is told at once, with its line", "[factory][broker]") {
  const ScratchFolder folder;
  const std::string faults = faults_of(written(folder, R"({
  "port": 70000,
  "qos": 0,
  "topic": "rvbench/+/result",
  "station_name": "a/b",
  "tls": {"ca": "none.pem"},
  "password_file": "none",
  "keepalive_s": 3
})"));
  using Catch::Contains;
  CHECK_THAT(faults, Contains("mqtt.json:1: /host: this key is missing"));
  CHECK_THAT(faults, Contains("mqtt.json:2: /port: 70000 is above 65535"));
  CHECK_THAT(faults, Contains("mqtt.json:3: /qos: 0 is below 1"));
  CHECK_THAT(faults, Contains("mqtt.json:4: /topic: must not hold the wildcards"));
  CHECK_THAT(faults, Contains("mqtt.json:5: /station_name: must be one level"));
  CHECK_THAT(faults, Contains("mqtt.json:6: /tls/ca: ") && Contains("none.pem\" is no file"));
  CHECK_THAT(faults, Contains("mqtt.json:7: /password_file: needs a \"user\""));
  CHECK_THAT(faults, Contains("/keepalive_s: unknown key, did you mean \"keep_alive_s\"?"));
}

TEST_CASE("a topic leaves room for the status beside it", "[factory][broker]") {
  const ScratchFolder folder;
  const auto fault = [&](const std::string& topic) {
    return faults_of(written(folder, R"({"host": "h", "topic": ")" + topic + "\"}"));
  };
  CHECK_THAT(fault("result"), Catch::Contains("needs two levels at least"));
  CHECK_THAT(fault("rvbench/status"), Catch::Contains("must not end in /status"));
  CHECK_THAT(fault("$SYS/result"), Catch::Contains("must not begin with $"));
}

TEST_CASE("a password that others can read is refused, an empty one too", "[factory][broker]") {
  const ScratchFolder folder;
  const std::string file =
      written(folder, R"({"host": "h", "user": "u", "password_file": "password"})");
  write_password(folder, "secret", true);
  CHECK_THAT(faults_of(file), Catch::Contains("is open to others: chmod 600 it"));
  CHECK_THAT(faults_of(file), !Catch::Contains("secret"));
  std::filesystem::remove(folder / "password");
  write_password(folder, "\n", false);
  CHECK_THAT(faults_of(file), Catch::Contains("holds no password"));
}

TEST_CASE("a password that goes over a network in the open is warned of", "[factory][broker]") {
  Broker broker{.host = "broker.example", .user = "u", .password = "secret"};
  REQUIRE(remarks_on(broker).size() == 1);
  CHECK_THAT(remarks_on(broker).front().message, Catch::Contains("without \"tls\""));
  broker.host = "127.0.0.1";
  CHECK(remarks_on(broker).empty());
}

TEST_CASE("check knows a broker file, and publish that a plan is none", "[factory][broker]") {
  const ScratchFolder folder;
  const std::string file = written(folder, R"({"host": "h"})");
  const test::CommandAnswer checked = test::rvbench({"check", file});
  CHECK(checked.code == 0);
  CHECK_THAT(checked.out, Catch::Contains("broker, no fault"));
  CHECK(test::rvbench({"check", written(folder, R"({"host": 5})")}).code == 3);
  const test::CommandAnswer refused = test::rvbench(
      {"publish", "--out", folder.path().string(), "--broker", written(folder, R"({"main": []})")});
  CHECK(refused.code == 3);
  CHECK_THAT(refused.err, Catch::Contains("seems to be a plan file, not a broker file"));
}

}  // namespace rvbench::bench
