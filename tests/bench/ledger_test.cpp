#include "bench/ledger.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/wait_until.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

void keep(const ScratchFolder& root, const std::string& file, const std::string& text) {
  LedgerPen(root.path()).keep("note", "EOL 3", file, text);
}

void put_at_end(const ScratchFolder& root, const std::string& text) {
  std::ofstream(root / ledger_name, std::ios::app) << text;
}

}  // namespace

TEST_CASE("a ledger tells what was kept, in the order it was kept", "[bench][ledger]") {
  const ScratchFolder root;
  CHECK(read_ledger(root.path()).lines.empty());
  CHECK(read_ledger(root.path()).fault.empty());
  keep(root, "b/second.json", "1");
  keep(root, "a/first.json", "2");
  keep(root, "b/second.json", "3");
  const Ledger ledger = read_ledger(root.path());
  REQUIRE(ledger.lines.size() == 3);
  CHECK(ledger.lines[1].number == 2);
  CHECK(ledger.lines[1].file == "a/first.json");
  CHECK(ledger.lines[1].of == "EOL 3");
  CHECK(ledger.last_of("b/second.json")->number == 3);
  CHECK(ledger.last_of("b/second.json")->sha256 == sha256_of_text("3"));
  CHECK(ledger.last_of("b/third.json") == nullptr);
  CHECK(read_file(root / "b/second.json") == "3");
  CHECK(ledger_faults(root.path()).empty());
  CHECK(test::rvbench({"check", (root / ledger_name).string()}).code == 0);
}

TEST_CASE("a file that was changed or taken away is told by its ledger", "[bench][ledger]") {
  const ScratchFolder root;
  keep(root, "a.json", "1");
  keep(root, "b.json", "2");
  write_file(root / "a.json", "9");
  std::filesystem::remove(root / "b.json");
  const auto faults = ledger_faults(root.path());
  REQUIRE(faults.size() == 2);
  CHECK_THAT(faults[0], Contains("a.json was changed since rvbench kept it"));
  CHECK_THAT(faults[1], Contains("b.json is missing"));
  const auto checked = test::rvbench({"check", (root / ledger_name).string()});
  CHECK(checked.code == 3);
  CHECK_THAT(checked.err, Contains("a.json was changed") && Contains("b.json is missing"));
}

TEST_CASE("what lies beside kept files and nobody kept is told, and no ledger is none",
          "[bench][ledger]") {
  const ScratchFolder root;
  keep(root, "a/0.json", "0");
  write_file(root / "a" / "by_hand.json", "{}");
  const auto faults = ledger_faults(root.path());
  REQUIRE(faults.size() == 1);
  CHECK_THAT(faults[0], Contains("by_hand.json is in no line of ledger.jsonl"));
  const ScratchFolder empty;
  CHECK(test::rvbench({"check", (empty / ledger_name).string()}).code == 3);
}

TEST_CASE("half a line that a power failure left is none, and the next one takes its place",
          "[bench][ledger]") {
  const ScratchFolder root;
  keep(root, "a.json", "1");
  put_at_end(root, R"({"number":2,"ut)");
  CHECK(read_ledger(root.path()).fault.empty());
  CHECK(read_ledger(root.path()).lines.size() == 1);
  const auto checked = test::rvbench({"check", (root / ledger_name).string()});
  CHECK(checked.code == 0);
  CHECK_THAT(checked.err, Contains("warning") && Contains("its last line was cut short"));
  keep(root, "b.json", "2");
  const Ledger ledger = read_ledger(root.path());
  CHECK(ledger.fault.empty());
  REQUIRE(ledger.lines.size() == 2);
  CHECK(ledger.lines[1].file == "b.json");
}

TEST_CASE("a file of a run is entered as it is, without those beside it", "[bench][ledger]") {
  const ScratchFolder root;
  std::filesystem::create_directories(root / "G01/20260102T030405Z");
  const std::string file = "G01/20260102T030405Z/verdict.json";
  CHECK_THROWS_AS(LedgerPen(root.path()).enter("ended", "EOL 3", file), std::system_error);
  write_file(root / file, "{}");
  write_file(root / "G01/20260102T030405Z/plan.json", "{}");
  LedgerPen(root.path()).enter("ended", "EOL 3", file);
  CHECK(read_ledger(root.path()).last_of(file)->sha256 == sha256_of_text("{}"));
  CHECK(ledger_faults(root.path()).empty());
  write_file(root / file, "{\"verdict\": \"PASS\"}");
  CHECK_THAT(ledger_faults(root.path()).at(0), Contains("verdict.json was changed"));
}

TEST_CASE("a ledger that was tampered with is trusted up to there, and nothing is added",
          "[bench][ledger]") {
  const ScratchFolder root;
  for (const char* name : {"a", "b", "c"}) keep(root, name, name);
  std::string text = read_file(root / ledger_name).value();
  const auto fault_with = [&](const std::string& changed) {
    write_file(root / ledger_name, changed);
    return read_ledger(root.path()).fault;
  };
  SECTION("a line was taken out") {
    const std::size_t begin = text.find('\n') + 1;
    text.erase(begin, text.find('\n', begin) + 1 - begin);
    CHECK_THAT(fault_with(text), Contains("ledger.jsonl:2: does not follow the line before"));
    CHECK(read_ledger(root.path()).lines.empty());  // what stood before may not be all
  }
  SECTION("a line was changed") {
    text.replace(text.find("EOL 3"), 5, "EOL 4");
    CHECK_THAT(fault_with(text), Contains("ledger.jsonl:1: was changed"));
  }
  SECTION("a line is none") {
    CHECK_THAT(fault_with("hello\n" + text), Contains("ledger.jsonl:1: is no line of such a log"));
  }
  CHECK_THROWS_AS(keep(root, "d", "d"), std::system_error);
  CHECK_FALSE(std::filesystem::exists(root / "d"));
}

TEST_CASE("a line that lacks only its end is one, and what is kept next begins below it",
          "[bench][ledger]") {
  const ScratchFolder root;
  keep(root, "a.json", "1");
  keep(root, "b.json", "2");
  std::string text = read_file(root / ledger_name).value();
  text.pop_back();
  write_file(root / ledger_name, text);
  CHECK(read_ledger(root.path()).lines.size() == 2);
  keep(root, "c.json", "3");
  CHECK(read_ledger(root.path()).lines.size() == 3);
  CHECK(ledger_faults(root.path()).empty());
}

TEST_CASE("who reads a ledger with its files finds both alike, whoever keeps something",
          "[bench][ledger]") {
  const ScratchFolder root;
  keep(root, "a/0.json", "0");
  constexpr int looks = 50;
  std::atomic<int> looked = 0;
  std::thread other([&] {
    for (int i = 1; looked < looks; ++i) {
      const int before = looked;
      keep(root, "a/" + std::to_string(i) + ".json", "");
      // Who writes without end lets nobody else have the lock.
      (void)rvbench::test::wait_until([&] { return looked != before; });
    }
  });
  for (; looked < looks; ++looked) CHECK(ledger_faults(root.path()).empty());
  other.join();
}

TEST_CASE("of many who keep something at once none is lost", "[bench][ledger]") {
  const ScratchFolder root;
  std::vector<std::thread> all;
  for (int i = 0; i < 8; ++i) {
    all.emplace_back([&, i] { keep(root, "f" + std::to_string(i), std::to_string(i)); });
  }
  for (std::thread& one : all) one.join();
  CHECK(read_ledger(root.path()).lines.size() == 8);
  CHECK(ledger_faults(root.path()).empty());
}

}  // namespace rvbench::bench
