#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::ScratchFolder;

// Another program that has the results open, and lets nobody write as long as it lives.
class Hog {
 public:
  explicit Hog(const std::filesystem::path& root)
      : program_(root, {"/usr/bin/python3", "-c",
                        "import sqlite3, sys, time\n"
                        "results = sqlite3.connect('results.db', isolation_level=None)\n"
                        "results.execute('PRAGMA journal_mode=WAL')\n"
                        "results.execute('BEGIN EXCLUSIVE')\n"
                        "print('locked', file=sys.stderr, flush=True)\n"
                        "time.sleep(3600)\n"}) {
    REQUIRE(program_.says("locked"));
  }

 private:
  test::Program program_;
};

test::Answer run(const ScratchFolder& scratch) {
  return test::rvbench(scratch.path(),
                       {"run", "short.json", "--rig", "sim", "--serial", "A17", "--json"});
}

}  // namespace

TEST_CASE("results that another program keeps locked cost no run", "[spec][results]") {
  const ScratchFolder scratch;
  bench::write_file(scratch.path() / "short.json", test::short_plan);
  const std::filesystem::path runs = scratch.path() / "runs";
  std::filesystem::create_directory(runs);
  const test::Answer locked_out = [&] {
    const Hog hog(runs);
    return run(scratch);
  }();
  INFO(locked_out.err);
  const auto folder = std::filesystem::directory_iterator(runs / "A17")->path();
  CHECK(bench::read_file(folder / "verdict.json") == locked_out.out);
  CHECK(nlohmann::json::parse(locked_out.out).at("exit_code") == locked_out.code);
  CHECK(bench::verify_sums(folder).empty());
  CHECK_THAT(locked_out.err,
             Contains("database is locked") && Contains("will be entered by the next run"));
  // Nobody locks them any more.
  CHECK(run(scratch).code == locked_out.code);
  const test::Answer history = test::rvbench(scratch.path(), {"history", "--json"});
  CHECK(nlohmann::json::parse(history.out).at("runs").size() == 2);
}

}  // namespace rvbench
