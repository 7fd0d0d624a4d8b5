#include <sqlite3.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "bench/factory/broker_file.hpp"
#include "bench/factory/mqtt_link.hpp"
#include "bench/factory/outbox.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/factory/judged_runs.hpp"
#include "tests/factory/mosquitto.hpp"
#include "tests/factory/subscriber.hpp"

namespace rvbench::test {
namespace {

using Catch::Contains;
using test::failed_run;
using test::passed_run;

std::vector<std::string> parts_of(const std::vector<nlohmann::json>& results) {
  std::vector<std::string> parts;
  for (const auto& result : results) parts.push_back(result["ResultMetaData"]["PartId"]);
  return parts;
}

}  // namespace

TEST_CASE("every judged run is sent once, oldest first", "[factory][publish]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  judged_run(root.path(), failed_run(), "A18", "20260102T030406Z");
  judged_run(root.path(), passed_run(), "A17", "20260102T030405Z");
  judged_run(root.path(), passed_run(), "A19", "20260102T030407Z");
  bench::create_run_folder(root.path(), "A20", "20260102T030408Z");  // at work
  const std::string broker = broker_file(place.path(), mosquitto.port());
  Subscriber factory(mosquitto.port(), "rvbench/b3/result");

  const Answer first = publish(root.path(), broker);
  INFO(first.err);
  CHECK(first.code == 0);
  CHECK(first.err.empty());
  CHECK_THAT(first.out, Contains("acknowledged: A17/20260102T030405Z, ResultId "));
  const auto results = factory.results(3);
  CHECK(parts_of(results) == std::vector<std::string>{"A17", "A18", "A19"});
  for (const auto& result : results) CHECK(result.at("PossibleDuplicate") == false);

  const Answer again = publish(root.path(), broker);
  CHECK(again.code == 0);
  CHECK(again.out.empty());
  CHECK(factory.messages(3).size() == 3);
  CHECK(mosquitto.publications("d0, q1, r0", "rvbench/b3/result") == 3);
}

TEST_CASE("the outbox tells what was sent, and a script can read it", "[factory][publish]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  judged_run(root.path(), passed_run(), "A17");
  Subscriber factory(mosquitto.port(), "rvbench/b3/result");
  const Answer answer =
      publish(root.path(), broker_file(place.path(), mosquitto.port()), {"--json"});
  const auto told = nlohmann::json::parse(answer.out);
  REQUIRE(told.at("acknowledged").size() == 1);
  const nlohmann::json entry = told.at("acknowledged").front();
  const auto sent = factory.messages(1).front();
  CHECK(entry.at("folder") == "A17/20260102T030405Z");
  CHECK(entry.at("payload_sha256") == bench::sha256_of_text(sent.payload));
  CHECK(entry.at("result_id") ==
        nlohmann::json::parse(sent.payload).at("ResultMetaData").at("ResultId"));
  CHECK(entry.at("sends") == 1);
  CHECK(entry.at("message_id") > 0);
  CHECK(told.at("left") == 0);
}

TEST_CASE("whether the station is online stays with the broker", "[factory][publish]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  judged_run(root.path(), passed_run(), "A17");
  Subscriber factory(mosquitto.port(), "rvbench/b3/status");
  CHECK(factory.messages(0).empty());
  CHECK(publish(root.path(), broker_file(place.path(), mosquitto.port())).code == 0);
  const auto seen = factory.messages(2);
  REQUIRE(seen.size() == 2);
  CHECK(seen[0].payload == "online");
  CHECK(seen[1].payload == "offline");
  Subscriber later(mosquitto.port(), "rvbench/b3/status");
  const auto kept = later.messages(1);
  REQUIRE(kept.size() == 1);
  CHECK(kept[0].payload == "offline");
  CHECK(kept[0].retained);
}

TEST_CASE("where nothing is due nothing is said, to the broker neither", "[factory][publish]") {
  const ScratchFolder root, place;
  const Socket nobody = reserved_port();
  const Answer answer = publish(root.path(), broker_file(place.path(), port_of(nobody)));
  CHECK(answer.code == 0);
  CHECK(answer.out.empty());
  CHECK(answer.err.empty());
}

TEST_CASE("while the broker is away results wait, once it is back each is sent once",
          "[factory][publish]") {
  Mosquitto mosquitto;
  mosquitto.kill();
  const ScratchFolder root, place;
  const auto folder = judged_run(root.path(), failed_run(), "A17");
  const std::string broker = broker_file(place.path(), mosquitto.port());
  const Answer away = publish(root.path(), broker, {"--json"});
  CHECK(away.code == 30);
  CHECK_THAT(away.err, Contains("nobody answers there") && Contains("1 result waits in "));
  CHECK(nlohmann::json::parse(away.out).at("exit_code") == 30);
  judged_run(root.path(), passed_run(), "A18", "20260102T030406Z");
  std::filesystem::remove_all(folder);  // it waits in the outbox, not in its folder

  mosquitto.start();
  Subscriber factory(mosquitto.port(), "rvbench/b3/result");
  CHECK(publish(root.path(), broker).code == 0);
  const auto results = factory.results(2);
  CHECK(parts_of(results) == std::vector<std::string>{"A17", "A18"});
  CHECK(results.front().at("PossibleDuplicate") == false);
}

TEST_CASE("a result that the outbox cannot note stays at home, and is sent once",
          "[factory][publish]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  const auto file = bench::read_broker(broker_file(place.path(), mosquitto.port()));
  auto opened = bench::Outbox::open(root.path());
  REQUIRE(opened);
  bench::Outbox outbox = std::move(opened).value();
  REQUIRE(outbox.enter({.result_id = "1", .folder = "A17/x", .payload = "{}"}));
  bench::MqttLink link(std::get<0>(file), outbox);
  REQUIRE(link.connect());
  const auto send = [&] { return link.send(outbox.next_due().value().value(), {}); };
  {
    auto other = bench::SqliteFile::open(root / bench::outbox_name, bench::outbox_name);
    REQUIRE(other);
    bench::SqliteFile file_of_other = std::move(other).value();
    const bench::SqlTransaction writing(file_of_other);  // and does not come to its end
    const Status locked = send();
    REQUIRE_FALSE(locked);
    CHECK_THAT(describe(locked.error()), Contains("locked"));
  }
  CHECK(outbox.next_due().value()->sends == 0);
  REQUIRE(send());
  CHECK(mosquitto.publications("d0, q1", "rvbench/b3/result") == 1);
}

TEST_CASE("what was acknowledged before the broker went is told", "[factory][publish]") {
  const Mosquitto mosquitto("allow_anonymous true\nmax_packet_size 20000");
  const ScratchFolder root, place;
  judged_run(root.path(), passed_run(), "A17");
  bench::Judgement large = failed_run();
  large.ending.reason = std::string(30'000, 'x');  // the broker hangs up
  judged_run(root.path(), large, "A18", "20260102T030406Z");
  const Answer answer =
      publish(root.path(), broker_file(place.path(), mosquitto.port()), {"--json"});
  CHECK(answer.code == 30);
  const auto told = nlohmann::json::parse(answer.out);
  CHECK(told.at("exit_code") == 30);
  CHECK(told.at("acknowledged").size() == 1);
  CHECK(told.at("left") == 1);
  CHECK_FALSE(told.at("reason").get<std::string>().empty());
}

TEST_CASE("a damaged verdict is skipped and told, the others go", "[factory][publish]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  bench::write_file(judged_run(root.path(), failed_run(), "A17") / "verdict.json", "{");
  judged_run(root.path(), passed_run(), "A18");
  Subscriber factory(mosquitto.port(), "rvbench/b3/result");
  const Answer answer =
      publish(root.path(), broker_file(place.path(), mosquitto.port()), {"--json"});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("not sent: A17/20260102T030405Z: its verdict.json is damaged"));
  CHECK(parts_of(factory.results(1)) == std::vector<std::string>{"A18"});
  const auto told = nlohmann::json::parse(answer.out);
  CHECK(told.at("skipped").front().at("folder") == "A17/20260102T030405Z");
}

TEST_CASE("publish refuses what it cannot work with", "[factory][publish]") {
  const ScratchFolder root, place;
  const std::string broker = broker_file(place.path(), 1);
  SECTION("no folder of runs") {
    const Answer answer = Program(root.path(), publish_words(root / "none", broker)).wait();
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("publish: no folder"));
  }
  SECTION("no broker file") {
    CHECK(publish(root.path(), (place / "none.json").string()).code == 3);
  }
  SECTION("an outbox that is none") {
    bench::write_file(root / "outbox.db", std::string(4096, 'x'));
    const Answer answer = publish(root.path(), broker);
    CHECK(answer.code == 20);
    CHECK_THAT(answer.err, Contains("outbox.db cannot be used"));
  }
  SECTION("an outbox that does not tell what waits there") {
    sqlite3* other = nullptr;
    REQUIRE(sqlite3_open((root / "outbox.db").c_str(), &other) == SQLITE_OK);
    REQUIRE(sqlite3_exec(other, "CREATE TABLE results (state, place)", nullptr, nullptr, nullptr) ==
            SQLITE_OK);
    sqlite3_close(other);
    const Answer answer = publish(root.path(), broker, {"--json"});
    CHECK(answer.code == 30);
    CHECK_THAT(answer.err, !Contains("nothing is left"));
    CHECK(nlohmann::json::parse(answer.out).at("left").is_null());
  }
}

}  // namespace rvbench::test
