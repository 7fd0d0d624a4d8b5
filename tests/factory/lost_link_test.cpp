#include <signal.h>

#include <catch2/catch.hpp>
#include <sstream>

#include "bench/factory/outbox.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/factory/judged_runs.hpp"
#include "tests/factory/mosquitto.hpp"
#include "tests/factory/subscriber.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench::test {
namespace {

using Catch::Contains;
using test::failed_run;
using test::passed_run;

constexpr const char* topic = "rvbench/b3/result";

std::size_t count_of(const ScratchFolder& root, const std::string& state) {
  const auto outbox = bench::Outbox::open(root.path());
  if (!outbox) return 0;
  const auto ids = outbox.value().ids_of(state);
  return ids ? ids.value().size() : 0;
}

// A publisher that is online, and a broker that does not answer any more: what comes to be judged
// is sent, but not acknowledged.
struct Unanswered {
  explicit Unanswered(const Mosquitto& at, const std::string& more)
      : mosquitto(at),
        broker(broker_file(place.path(), at.port(), R"(, "keep_alive_s": 5)" + more)),
        publisher(std::make_unique<Program>(root.path(),
                                            publish_words(root.path(), broker, {"--follow"}))) {
    REQUIRE(publisher->says("connected to the MQTT broker"));
    REQUIRE(wait_until([&] { return at.publications("d0", "rvbench/b3/status") == 1; }));
    REQUIRE(mosquitto.send(SIGSTOP));
    judged_run(root.path(), passed_run(), "A17");
    REQUIRE(wait_until([&] { return count_of(root, "sent") == 1; }));
    // It is noted before it goes out; a ping has two bytes.
    REQUIRE(wait_until([&] { return at.unread_bytes() > 100; }));
  }

  void kill() {
    REQUIRE(publisher->send(SIGKILL));
    publisher->wait();
  }

  const Mosquitto& mosquitto;
  ScratchFolder root, place;
  std::string broker;
  std::unique_ptr<Program> publisher;
};

std::string id_of(const nlohmann::json& result) { return result["ResultMetaData"]["ResultId"]; }

}  // namespace

TEST_CASE("at QoS 1 a process killed before the acknowledgement sends again, marked",
          "[factory][lost]") {
  const Mosquitto mosquitto;
  Subscriber factory(mosquitto.port(), topic);
  Unanswered killed(mosquitto, R"(, "qos": 1)");
  killed.kill();
  REQUIRE(mosquitto.send(SIGCONT));
  const Answer again = publish(killed.root.path(), killed.broker);
  CHECK(again.code == 0);
  CHECK_THAT(again.out, Contains(", sent before"));
  const auto results = factory.results(2);
  REQUIRE(results.size() == 2);
  CHECK(id_of(results[0]) == id_of(results[1]));
  CHECK(results[0].at("PossibleDuplicate") == false);
  CHECK(results[1].at("PossibleDuplicate") == true);
  CHECK(count_of(killed.root, "acknowledged") == 1);
}

TEST_CASE("at QoS 2 a process killed before the acknowledgement has sent once", "[factory][lost]") {
  const Mosquitto mosquitto;
  Subscriber factory(mosquitto.port(), topic);
  Unanswered killed(mosquitto, R"(, "qos": 2)");
  killed.kill();
  REQUIRE(mosquitto.send(SIGCONT));
  const Answer again = publish(killed.root.path(), killed.broker);
  CHECK(again.code == 0);
  CHECK_THAT(again.out, Contains("acknowledged: A17/"));
  const auto results = factory.results(1);
  REQUIRE(results.size() == 1);
  CHECK(results[0].at("PossibleDuplicate") == false);
  CHECK(mosquitto.publications("d0, q2", topic) == 1);
  CHECK(mosquitto.publications("d1, q2", topic) == 1);  // the same packet, which the broker knew
  CHECK(count_of(killed.root, "acknowledged") == 1);
}

TEST_CASE("a broker that has lost its sessions gets the result again, marked", "[factory][lost]") {
  Mosquitto mosquitto;
  Unanswered unanswered(mosquitto, R"(, "qos": 2)");
  unanswered.kill();
  mosquitto.kill();  // it keeps nothing on its disk
  mosquitto.start();
  Subscriber factory(mosquitto.port(), topic);
  CHECK(publish(unanswered.root.path(), unanswered.broker).code == 0);
  const auto results = factory.results(1);
  REQUIRE_FALSE(results.empty());
  CHECK(results.back().at("PossibleDuplicate") == true);
  CHECK(count_of(unanswered.root, "acknowledged") == 1);
}

TEST_CASE("who follows outlives the broker and ends in order", "[factory][lost]") {
  Mosquitto mosquitto;
  Unanswered follower(mosquitto, "");
  mosquitto.kill();
  REQUIRE(follower.publisher->says("nothing is lost, trying again"));
  CHECK(count_of(follower.root, "acknowledged") == 0);
  mosquitto.start();
  REQUIRE(wait_until([&] { return count_of(follower.root, "acknowledged") == 1; }));
  const Answer second = publish(follower.root.path(), follower.broker);
  CHECK(second.code == 2);
  CHECK_THAT(second.err, Contains("another rvbench publish is at work"));

  judged_run(follower.root.path(), passed_run(), "A18");
  REQUIRE(wait_until([&] { return count_of(follower.root, "acknowledged") == 2; }));
  REQUIRE(follower.publisher->send(SIGTERM));
  const Answer ended = follower.publisher->wait();
  CHECK(ended.code == 0);
  CHECK_THAT(ended.out, Contains("acknowledged: A17/") && Contains("acknowledged: A18/"));
  Subscriber factory(mosquitto.port(), "rvbench/b3/status");
  CHECK(factory.messages(1).front().payload == "offline");
}

TEST_CASE("who follows tells each acknowledged result in a line of JSON", "[factory][lost]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  Program publisher(root.path(),
                    publish_words(root.path(), broker_file(place.path(), mosquitto.port()),
                                  {"--follow", "--json"}));
  judged_run(root.path(), passed_run(), "A17");
  judged_run(root.path(), failed_run(), "A18", "20260102T030406Z");
  REQUIRE(wait_until([&] { return count_of(root, "acknowledged") == 2; }));
  REQUIRE(publisher.send(SIGTERM));
  const Answer answer = publisher.wait();
  CHECK(answer.code == 0);
  std::istringstream lines(answer.out);
  std::string first, second, none;
  REQUIRE(std::getline(lines, first));
  REQUIRE(std::getline(lines, second));
  CHECK_FALSE(std::getline(lines, none));
  CHECK_THAT(nlohmann::json::parse(first).at("folder").get<std::string>(), Contains("A17/"));
  CHECK_THAT(nlohmann::json::parse(second).at("folder").get<std::string>(), Contains("A18/"));
}

TEST_CASE("a result that the broker does not take holds up no other", "[factory][lost]") {
  for (const char* qos : {"", R"(, "qos": 2)"}) {
    CAPTURE(qos);
    const Mosquitto mosquitto("allow_anonymous true\nmax_packet_size 20000");
    const ScratchFolder root, place;
    bench::Judgement large = failed_run();
    large.ending.reason = std::string(30'000, 'x');
    const auto folder = judged_run(root.path(), large, "A17");
    judged_run(root.path(), passed_run(), "A18", "20260102T030406Z");
    const std::string broker = broker_file(place.path(), mosquitto.port(), qos);
    Answer answer;
    for (int i = 0; i < 3; ++i) answer = publish(root.path(), broker);
    CHECK(answer.code == 30);
    CHECK_THAT(answer.err, Contains("A17/") && Contains("goes after the others"));
    answer = publish(root.path(), broker);
    CHECK(answer.code == 30);  // the first one still waits
    CHECK_THAT(answer.out, Contains("acknowledged: A18/"));
    CHECK(count_of(root, "acknowledged") == 1);
  }
}

TEST_CASE("a session that nobody follows any more is ended before anything is sent in it",
          "[factory][lost]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  const std::string broker = broker_file(place.path(), mosquitto.port(), R"(, "qos": 2)");
  const auto clean_sessions = [&] {
    const std::string log = mosquitto.log();
    std::size_t count = 0;
    for (std::size_t at = 0; (at = log.find(", c1, ", at)) != std::string::npos; ++at) ++count;
    return count;
  };
  judged_run(root.path(), passed_run(), "A17");
  REQUIRE(publish(root.path(), broker).code == 0);
  CHECK(clean_sessions() == 0);                        // there was none before
  std::filesystem::remove(root / bench::outbox_name);  // and with it what was under way
  REQUIRE(publish(root.path(), broker).code == 0);
  CHECK(clean_sessions() == 1);
  CHECK(mosquitto.publications("d0, q2", topic) == 2);
}

TEST_CASE("of a follower that is killed its will tells the factory", "[factory][lost]") {
  const Mosquitto mosquitto;
  const ScratchFolder root, place;
  Subscriber factory(mosquitto.port(), "rvbench/b3/status");
  const std::string broker = broker_file(place.path(), mosquitto.port());
  Program publisher(root.path(), publish_words(root.path(), broker, {"--follow"}));
  CHECK(factory.messages(1).back().payload == "online");
  REQUIRE(publisher.send(SIGKILL));
  CHECK(factory.messages(2).back().payload == "offline");
}

}  // namespace rvbench::test
