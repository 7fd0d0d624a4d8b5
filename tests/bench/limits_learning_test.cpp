#include "bench/limits_learning.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <numeric>

#include "bench/find_plan.hpp"
#include "bench/limits_in_force.hpp"
#include "bench/limits_versions.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/entered_run.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/signals.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

// Peaks of good units in m/s²: 1 g would be ten times as much.
std::vector<double> good_peaks(int count) {
  const Eigen::VectorXd x = 1 + 0.1 * rvbench::test::white_noise(count, 4).array();
  return {x.begin(), x.end()};
}

void enter(const ScratchFolder& root, const std::vector<double>& peaks_m_s2,
           Outcome outcome = Outcome::pass, const std::string& utc = "20260102T030405Z") {
  for (std::size_t i = 0; i < peaks_m_s2.size(); ++i) {
    Judgement judgement = test::passed_run();
    judgement.facts.serial = fmt::format("U{:02}", i);
    judgement.points[0].examination.channels[0].indicators = {
        {"acceleration_peak", "", peaks_m_s2[i], "m/s²"}};
    judgement.facts.started_utc = utc;
    judgement.ending.outcome = outcome;
    test::enter_run(root.path(), judgement);
  }
}

double learnt_max_g(const std::vector<double>& peaks_m_s2) {
  const ScratchFolder root;
  enter(root, peaks_m_s2);
  REQUIRE(test::limits(root.path(), {"learn", "v1", "--plan", "quick"}).code == 0);
  return std::get<0>(read_limits_file(limits_path(root.path(), "v1"))).limits.at(0).max;
}

double mean_and_four_sigma(const std::vector<double>& x) {
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / double(x.size());
  double squares = 0;
  for (const double value : x) squares += (value - mean) * (value - mean);
  return mean + 4 * std::sqrt(squares / double(x.size() - 1));
}

}  // namespace

TEST_CASE("three noisy units among fifty do not widen what is learnt", "[bench][limits]") {
  const std::vector<double> good = good_peaks(50);
  std::vector<double> trapped = good;
  for (const std::size_t i : {7U, 23U, 41U}) trapped[i] = 2;
  const double clean_g = learnt_max_g(good), trapped_g = learnt_max_g(trapped);
  CHECK(clean_g > 1.3 / 9.80665);
  CHECK(clean_g < 1.7 / 9.80665);
  CHECK(std::abs(trapped_g / clean_g - 1) < 0.1);
  CHECK(mean_and_four_sigma(trapped) > 1.1 * mean_and_four_sigma(good));
}

TEST_CASE("what is learnt is a draft that says where it comes from", "[bench][limits]") {
  const ScratchFolder root;
  std::vector<double> peaks = good_peaks(50);
  peaks[7] = 2;
  enter(root, peaks);
  const test::CommandAnswer learnt = test::limits(root.path(), {"learn", "v1", "--plan", "quick"});
  CHECK(learnt.code == 0);
  CHECK_THAT(learnt.out, Contains("acceleration_peak: max ") && Contains("in force 1 g") &&
                             Contains("of 50 units") && Contains("set aside") && Contains("U07") &&
                             Contains("2.0 % of 50 judged runs would change"));
  const auto file = std::get<0>(read_limits_file(limits_path(root.path(), "v1")));
  CHECK(status_of(file, root.path()) == "draft");
  CHECK_THAT(file.limits.at(0).why, Contains("robust sigma of 50 good units"));
  CHECK(test::limits(root.path(), {"learn", "v1", "--plan", "quick"}).code == 2);
  CHECK(test::limits(root.path(), {"approve", "v1", "--yes"}).code == 0);
  CHECK(test::limits(root.path(), {"activate", "v1"}).code == 0);
  CHECK(std::get<0>(active_limits(root.path(), "quick"))->version == "v1");
}

TEST_CASE("of units that scatter otherwise than normally no share is promised", "[bench][limits]") {
  const ScratchFolder root;
  std::vector<double> skewed = good_peaks(24);
  for (const std::size_t i : {3U, 11U, 20U}) skewed[i] = 3;  // an eighth
  enter(root, skewed);
  const test::CommandAnswer learnt = test::limits(root.path(), {"learn", "v1", "--plan", "quick"});
  CHECK(learnt.code == 0);
  CHECK_THAT(learnt.out, Contains("3 of 24 good units are unlike the others"));
  const auto file = std::get<0>(read_limits_file(limits_path(root.path(), "v1")));
  CHECK_THAT(file.limits.at(0).why, Contains("3 of them set aside") && !Contains("confidence"));
  const ScratchFolder normal;
  enter(normal, good_peaks(24));
  const test::CommandAnswer sound = test::limits(normal.path(), {"learn", "v1", "--plan", "quick"});
  CHECK_THAT(sound.out, !Contains("unlike the others"));
}

TEST_CASE("limits that the results remember are not forgotten with the ledger", "[bench][limits]") {
  const ScratchFolder root;
  enter(root, good_peaks(20));
  REQUIRE(test::limits(root.path(), {"learn", "v1", "--plan", "quick"}).code == 0);
  REQUIRE(test::limits(root.path(), {"approve", "v1", "--yes"}).code == 0);
  REQUIRE(test::limits(root.path(), {"activate", "v1"}).code == 0);
  REQUIRE(test::rvbench({"history", "--out", root.path().string()}).code == 0);
  const auto in_force = [&] {
    auto plan = std::get<0>(find_plan("quick"));
    return put_in_force(root.path(), "quick", plan);
  };
  CHECK(std::get<0>(in_force()).version == "v1");
  const ScratchFolder elsewhere;
  const std::string copy = (elsewhere / "v1.json").string();
  std::filesystem::copy(limits_path(root.path(), "v1"), copy);
  std::filesystem::remove_all(root / limits_folder_name);
  std::filesystem::remove(root / ledger_name);
  CHECK_THAT(std::get<1>(in_force()),
             Contains("limits v1 of plan quick were activated, as results.db remembers"));
  auto other = std::get<0>(find_plan("rv20e_acceptance"));
  CHECK(std::get<0>(put_in_force(root.path(), "rv20e_acceptance", other)).version.empty());

  CHECK(test::limits(root.path(), {"learn", "v2", "--plan", "quick"}).code == 2);
  REQUIRE(test::limits(root.path(), {"propose", "--from", copy}).code == 0);
  CHECK(in_force().index() == 1);  // nobody has approved it
  REQUIRE(test::limits(root.path(), {"approve", "v1", "--yes"}).code == 0);
  REQUIRE(test::limits(root.path(), {"activate", "v1"}).code == 0);
  CHECK(std::get<0>(in_force()).version == "v1");
}

TEST_CASE("the depth of each part is learnt from what good units show, or their noise may hide",
          "[bench][limits]") {
  const ScratchFolder root;
  const Eigen::VectorXd noise = rvbench::test::white_noise(24, 4);
  for (int i = 0; i < 24; ++i) {
    Judgement judgement = test::passed_run();
    judgement.facts.serial = fmt::format("U{:02}", i);
    analysis::Finding shaft = test::misaligned_shaft();
    shaft.severity = i == 5 ? 0.9 : 0.1 + 0.01 * noise[i];
    judgement.diagnosis.findings.clear();
    judgement.diagnosis.below_limit = {shaft};
    analysis::Finding sun = test::silent_sun();
    sun.severity_high = 0.02 + 0.002 * noise[23 - i];
    judgement.diagnosis.not_shown = {sun};
    test::enter_run(root.path(), judgement);
  }
  const test::CommandAnswer learnt = test::limits(
      root.path(), {"learn", "v1", "--plan", "quick", "--measure", "modulation_depth"});
  CHECK(learnt.code == 0);
  CHECK_THAT(learnt.out, Contains("modulation_depth of input_shaft: max") &&
                             Contains("unlike the others: U05") &&
                             Contains("modulation_depth of pin_housing: not learnt: 0 units"));
  const auto file = std::get<0>(read_limits_file(limits_path(root.path(), "v1")));
  for (const sequences::Limit& limit : file.limits) {
    if (limit.component == "input_shaft") CHECK(limit.max == Approx(0.15).margin(0.02));
    if (limit.component == "sun_gear") CHECK(limit.max == Approx(0.03).margin(0.005));
  }
}

TEST_CASE("simulated units teach no limit where real ones do", "[bench][limits]") {
  const ScratchFolder root;
  enter(root, good_peaks(20));
  Judgement real = test::passed_run();
  real.facts.serial = "R01";
  test::enter_run(root.path(), real, "bench");
  const test::CommandAnswer few = test::limits(root.path(), {"learn", "v1", "--plan", "quick"});
  CHECK(few.code == 20);
  CHECK_THAT(few.out, Contains("from runs on rigs of kind bench alone"));
  const test::CommandAnswer asked =
      test::limits(root.path(), {"learn", "v1", "--plan", "quick", "--rig-kind", "sim"});
  CHECK(asked.code == 0);
  CHECK_THAT(asked.out, Contains("of 20 units"));
  const auto file = std::get<0>(read_limits_file(limits_path(root.path(), "v1")));
  CHECK_THAT(file.limits.at(0).why, Contains(", rig sim, "));
}

TEST_CASE("a run whose verdict is gone or was changed teaches nothing", "[bench][limits]") {
  const ScratchFolder root;
  enter(root, good_peaks(23));
  std::filesystem::remove_all(root / "U03");
  enter(root, {1}, Outcome::fail, "20260103T030405Z");  // U00 fails, and it is hidden
  std::filesystem::remove_all(root / "U00/20260103T030405Z");
  const auto changed = root / "U05/20260102T030405Z/verdict.json";
  write_file(changed, read_file(changed).value() + "\n");
  const test::CommandAnswer learnt = test::limits(root.path(), {"learn", "v1", "--plan", "quick"});
  CHECK(learnt.code == 0);
  CHECK_THAT(learnt.out, Contains("U03/20260102T030405Z: teaches nothing") &&
                             Contains("U05/20260102T030405Z: teaches nothing") &&
                             Contains("of 20 units"));
}

TEST_CASE("a unit that failed since is no good one, and one that passed since is",
          "[bench][limits]") {
  const ScratchFolder root;
  enter(root, good_peaks(20));
  REQUIRE(test::limits(root.path(), {"learn", "v1", "--plan", "quick"}).code == 0);
  enter(root, {1}, Outcome::fail, "20260103T030405Z");  // U00 again
  const test::CommandAnswer few = test::limits(root.path(), {"learn", "v2", "--plan", "quick"});
  CHECK(few.code == 20);
  CHECK_THAT(few.out, Contains("19 units, and a limit takes 20"));
  enter(root, {1}, Outcome::pass, "20260104T030405Z");
  CHECK(test::limits(root.path(), {"learn", "v2", "--plan", "quick"}).code == 0);
}

TEST_CASE("from too few units, or none, no draft is made", "[bench][limits]") {
  const ScratchFolder root;
  CHECK(test::limits(root.path(), {"learn", "v1", "--plan", "quick"}).code == 20);
  enter(root, good_peaks(19));
  const test::CommandAnswer few = test::limits(root.path(), {"learn", "v1", "--plan", "quick"});
  CHECK(few.code == 20);
  CHECK_THAT(few.out, Contains("19 units, and a limit takes 20"));
  CHECK_FALSE(std::filesystem::exists(limits_path(root.path(), "v1")));
  CHECK(test::limits(root.path(), {"learn", "v1"}).code == 2);
  CHECK_THAT(
      test::limits(root.path(), {"learn", "v1", "--plan", "quick", "--measure", "kurtosi"}).err,
      Contains("kurtosis"));
  enter(root, good_peaks(25));
  write_file(root / "good.txt", "U01\nU02\n");
  CHECK_THAT(test::limits(root.path(), {"learn", "v1", "--plan", "quick", "--serials",
                                        (root / "good.txt").string()})
                 .out,
             Contains("2 units, and a limit takes 20"));
}

}  // namespace rvbench::bench
