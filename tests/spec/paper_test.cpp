#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "bench/find_plan.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "sequences/plan.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/spec/rvbench.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench {
namespace {

using Catch::Matchers::Contains;
using test::Answer;
using test::ScratchFolder;

}  // namespace

TEST_CASE("without fonts there is no report on paper, and it says what to install", "[spec][pdf]") {
  const ScratchFolder scratch;
  const auto run = scratch.path() / "run";
  std::filesystem::create_directory(run);
  bench::write_file(run / "plan.json",
                    sequences::plan_to_json(std::get<0>(bench::find_plan("quick"))));
  bench::write_file(run / "kinematics.json", bench::kinematics_text("rv20e"));
  bench::write_file(run / "verdict.json", bench::judgement_to_json(test::passed_run()));
  bench::write_sums(run);
  bench::write_file(scratch / "none.conf",
                    "<?xml version=\"1.0\"?>\n<!DOCTYPE fontconfig SYSTEM \"fonts.dtd\">\n"
                    "<fontconfig><dir>/nowhere</dir></fontconfig>\n");
  const std::string nothing = "FONTCONFIG_FILE=" + (scratch / "none.conf").string();
  const Answer answer =
      test::Program(scratch.path(),
                    {"/usr/bin/env", nothing, test::rvbench_path(), "report", "run", "--pdf"})
          .wait();
  CHECK(answer.code == 2);
  CHECK_THAT(answer.err,
             Contains("there is no font to set it in") && Contains("fonts-dejavu-core"));
  CHECK_FALSE(std::filesystem::exists(run / "report.pdf"));
  CHECK(bench::verify_sums(run).empty());  // left as it was
}

}  // namespace rvbench
