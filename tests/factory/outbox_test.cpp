#include "bench/factory/outbox.hpp"

#include <sqlite3.h>

#include <catch2/catch.hpp>

#include "bench/run_folder.hpp"
#include "bench/text_file.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using rvbench::test::ScratchFolder;
using Ids = std::vector<std::string>;

namespace {

Outbox opened(const ScratchFolder& root) {
  auto outbox = Outbox::open(root.path());
  REQUIRE(outbox);
  return std::move(outbox).value();
}

Ids ids_of(const Outbox& outbox, const std::string& state) {
  const auto ids = outbox.ids_of(state);
  REQUIRE(ids);
  return ids.value();
}

void enter(Outbox& outbox, const Ids& ids) {
  for (const std::string& id : ids) {
    REQUIRE(outbox.enter({.result_id = id, .folder = "A17/" + id, .payload = "{}"}));
  }
}

}  // namespace

TEST_CASE("what is due is kept in the order in which it came", "[factory][outbox]") {
  const ScratchFolder root;
  {
    Outbox outbox = opened(root);
    enter(outbox, {"2", "1"});
    CHECK_FALSE(outbox.enter({.result_id = "1", .folder = "A17/1", .payload = "{}"}));
  }
  const Outbox outbox = opened(root);
  CHECK(ids_of(outbox, "due") == Ids{"2", "1"});
  CHECK(outbox.next_due().value()->folder == "A17/2");
  CHECK(outbox.holds("1").value());
  CHECK_FALSE(outbox.holds("3").value());
  CHECK_FALSE(outbox.find("3").value());
}

TEST_CASE("a result is due, then sent, then acknowledged", "[factory][outbox]") {
  const ScratchFolder root;
  Outbox outbox = opened(root);
  enter(outbox, {"1", "2"});
  const std::string packet("\x32\x00\xff", 3);
  REQUIRE(outbox.note_attempt("1"));
  CHECK(outbox.next_due().value()->sends == 1);  // whatever becomes of it
  REQUIRE(outbox.note_sent("1", 7, "abc", "s-7", packet));
  CHECK(ids_of(outbox, "sent") == Ids{"1"});
  CHECK(outbox.next_due().value()->result_id == "2");
  const OutboxEntry sent = outbox.find("1").value().value();
  CHECK(sent.message_id == 7);
  CHECK(sent.sends == 1);
  CHECK(sent.payload_sha256 == "abc");
  CHECK(opened(root).packet("s-7") == packet);

  REQUIRE(outbox.acknowledge("s-7"));
  CHECK(ids_of(outbox, "acknowledged") == Ids{"1"});
  CHECK(outbox.find("1").value()->payload.empty());
  CHECK(outbox.packet_keys().empty());
}

TEST_CASE("an acknowledgement of something else changes no result", "[factory][outbox]") {
  const ScratchFolder root;
  Outbox outbox = opened(root);
  enter(outbox, {"1"});
  REQUIRE(outbox.note_sent("1", 7, "abc", "s-7", "packet"));
  REQUIRE(outbox.acknowledge("s-8"));
  CHECK(ids_of(outbox, "sent") == Ids{"1"});
}

TEST_CASE("what is recalled is due again in its old place, and known as sent before",
          "[factory][outbox]") {
  const ScratchFolder root;
  Outbox outbox = opened(root);
  enter(outbox, {"1", "2"});
  REQUIRE(outbox.note_attempt("1"));
  REQUIRE(outbox.note_sent("1", 7, "abc", "s-7", "packet"));
  REQUIRE(outbox.recall());
  CHECK(ids_of(outbox, "due") == Ids{"1", "2"});
  CHECK(outbox.next_due().value()->sends == 1);
  CHECK(outbox.packet_keys().empty());
}

TEST_CASE("an outbox that cannot be used is told, and why", "[factory][outbox]") {
  const ScratchFolder root;
  SECTION("it is no database") {
    write_file(root / "outbox.db", std::string(4096, 'x'));
    const auto outbox = Outbox::open(root.path());
    REQUIRE_FALSE(outbox);
    CHECK_THAT(outbox.error().where,
               Catch::Contains("outbox.db cannot be used") && Catch::Contains("not a database"));
  }
  SECTION("somebody keeps it locked") {
    Outbox outbox = opened(root);
    sqlite3* other = nullptr;
    REQUIRE(sqlite3_open((root / "outbox.db").c_str(), &other) == SQLITE_OK);
    REQUIRE(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr) == SQLITE_OK);
    const Status entered = outbox.enter({.result_id = "1", .folder = "A17/1", .payload = "{}"});
    REQUIRE_FALSE(entered);
    CHECK_THAT(entered.error().where, Catch::Contains("database is locked"));
    sqlite3_close(other);
  }
}

TEST_CASE("no serial takes the place of the outbox", "[factory][outbox]") {
  for (const char* serial : {"outbox.db", "outbox.db-wal", "outbox.db.lock"}) {
    CHECK_FALSE(folder_name_of(serial).starts_with(outbox_name));
  }
}

}  // namespace rvbench::bench
