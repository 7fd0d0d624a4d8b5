#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "tests/spec/bench_run.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/under_sanitizer.hpp"

// A run on what another run recorded, as if that were hardware: the twin is the bench's plant.
namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::ScratchFolder;

std::filesystem::path only_run(const ScratchFolder& scratch, const std::string& serial) {
  return std::filesystem::directory_iterator(scratch.path() / "runs" / serial)->path();
}

Answer run(const ScratchFolder& scratch, const std::string& rig, const std::string& serial,
           const std::vector<std::string>& more = {}) {
  std::vector<std::string> words{"run", "plan.json", "--rig", rig, "--serial", serial};
  words.insert(words.end(), more.begin(), more.end());
  return test::rvbench(scratch.path(), words);
}

// Runs a unit of the simulated bench, and once more what was recorded of it.
struct Replayed {
  explicit Replayed(const std::string& preset, const std::string& rig_more = "") {
    bench::write_file(
        scratch / "plan.json",
        test::replaced(test::replaced(test::short_plan_with_limits(), "[1210]", "[1815]"), "[50]",
                       "[100]"));
    simulated = run(scratch, "sim", "SIM", {"--preset", preset, "--seed", "3"});
    bench::write_file(scratch / "rig.json",
                      R"({"rig": "replay", "recording": ")" +
                          (only_run(scratch, "SIM") / "recording.h5").string() + "\"" + rig_more +
                          "}");
    replayed = run(scratch, "rig.json", "REPLAY");
  }
  std::string log() const {
    return bench::read_file(only_run(scratch, "REPLAY") / "log.jsonl").value_or("");
  }

  ScratchFolder scratch;
  Answer simulated, replayed;
};

}  // namespace

TEST_CASE("a good unit is as its twin, and nothing is said of it", "[spec][twin]") {
  const Replayed good("healthy");
  INFO(good.replayed.err);
  CHECK(good.replayed.code == 0);
  CHECK_THAT(good.replayed.out, !Contains("twin"));
  CHECK_THAT(good.log(), Contains("as its twin rv20e_bench"));
  CHECK(bench::verify_sums(only_run(good.scratch, "REPLAY")).empty());
}

TEST_CASE("a unit whose torque its twin does not have is told in one line", "[spec][twin]") {
  if (test::too_long_under_sanitizer()) return;
  const Replayed bent("input_shaft");
  CHECK_THAT(bent.replayed.out,
             Contains("The run differs from its twin rv20e_bench: input_torque, order 1.983 "
                      "(240/121) at 1815 rpm, 100 %") &&
                 Contains("rvbench explain runs/REPLAY/"));
  CHECK(bent.replayed.code == bent.simulated.code);   // the verdict is of the unit alone
  CHECK_THAT(bent.simulated.out, !Contains("twin"));  // a simulated bench is its own
}

TEST_CASE("a plant that does not fit what was recorded is a line of the log", "[spec][twin]") {
  const Replayed other("healthy", R"(, "plant": "emps")");
  CHECK(other.replayed.code == 0);
  CHECK_THAT(other.replayed.out, !Contains("twin"));
  CHECK_THAT(other.log(), Contains("not compared with its twin: "));
}

}  // namespace rvbench
