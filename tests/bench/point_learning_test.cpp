#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "bench/limits_versions.hpp"
#include "bench/result_database.hpp"
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

const SetPoint slow{1210, 50}, fast{1815, 100};

JudgedPoint point_with_peak(const SetPoint& at, double peak_m_s2) {
  JudgedPoint point = test::recorded_point();
  point.planned_speed_rpm = *at.speed_rpm;
  point.examination.load_pct = *at.load_pct;
  point.examination.channels[0].indicators = {{"acceleration_peak", "", peak_m_s2, "m/s²"}};
  return point;
}

// Good units of the quick plan, three times as loud at the fast point as at the slow one.
void enter(const ScratchFolder& root, const std::vector<double>& slow_m_s2,
           const std::vector<double>& fast_m_s2) {
  for (std::size_t i = 0; i < slow_m_s2.size(); ++i) {
    Judgement judgement = test::passed_run();
    judgement.facts.serial = fmt::format("U{:02}", i);
    judgement.points = {point_with_peak(slow, slow_m_s2[i]), point_with_peak(fast, fast_m_s2[i])};
    test::enter_run(root.path(), judgement);
  }
}

std::vector<double> peaks() {
  const Eigen::VectorXd x = 1 + 0.1 * rvbench::test::white_noise(50, 4).array();
  return {x.begin(), x.end()};
}

std::vector<double> three_times(std::vector<double> values) {
  for (double& value : values) value *= 3;
  return values;
}

// Limits of peaks: the plan has others that no unit here shows.
std::vector<sequences::Limit> peak_limits(const ScratchFolder& root, const std::string& version) {
  std::vector<sequences::Limit> limits =
      std::get<0>(read_limits_file(limits_path(root.path(), version))).limits;
  std::erase_if(limits,
                [](const sequences::Limit& limit) { return limit.measure != "acceleration_peak"; });
  return limits;
}

// The bounds of version v1, by where they hold.
double max_at(const ScratchFolder& root, const SetPoint& at) {
  for (const sequences::Limit& limit : peak_limits(root, "v1")) {
    if (limit.at == at) return limit.max;
  }
  return not_known;
}

}  // namespace

TEST_CASE("each point of the matrix gets a limit of its own, beside the one for all",
          "[bench][limits]") {
  const ScratchFolder root;
  enter(root, peaks(), three_times(peaks()));
  const test::CommandAnswer learnt =
      test::limits(root.path(), {"learn", "v1", "--plan", "quick", "--per-point"});
  CHECK(learnt.code == 0);
  CHECK_THAT(learnt.out,
             Contains("acceleration_peak at 1210 rpm, 50 % load: max ") &&
                 Contains("acceleration_peak at 1815 rpm, 100 % load: max ") &&
                 Contains("in force 1 g") &&
                 Contains("acceleration_peak at 1815 rpm, 50 % load: not learnt: 0 units"));
  // What is three times as loud has three times the limit, whatever the robust factor.
  CHECK(max_at(root, fast) == Approx(3 * max_at(root, slow)));
  CHECK(max_at(root, slow) > 1.3 / 9.80665);
  CHECK(max_at(root, slow) < 1.7 / 9.80665);
  CHECK(max_at(root, {}) == 1.0);  // the plan's own stays
  CHECK(std::isnan(max_at(root, {1815, 50})));
  CHECK(std::isnan(max_at(root, {1210, 100})));
  CHECK(test::rvbench({"check", limits_path(root.path(), "v1").string()}).code == 0);
}

TEST_CASE("without --per-point one limit is for the worst of all points", "[bench][limits]") {
  const ScratchFolder apart, together;
  enter(apart, peaks(), three_times(peaks()));
  enter(together, three_times(peaks()), three_times(peaks()));
  CHECK(test::limits(apart.path(), {"learn", "v1", "--plan", "quick"}).code == 0);
  CHECK(test::limits(together.path(), {"learn", "v1", "--plan", "quick"}).code == 0);
  CHECK(max_at(apart, {}) == Approx(max_at(together, {})));
  CHECK(std::isnan(max_at(apart, fast)));
}

TEST_CASE("three noisy units at one point widen no limit there, nor elsewhere", "[bench][limits]") {
  const ScratchFolder clean, trapped;
  std::vector<double> noisy = three_times(peaks());
  for (const std::size_t i : {7U, 23U, 41U}) noisy[i] *= 2;
  enter(clean, peaks(), three_times(peaks()));
  enter(trapped, peaks(), noisy);
  CHECK(test::limits(clean.path(), {"learn", "v1", "--plan", "quick", "--per-point"}).code == 0);
  const test::CommandAnswer learnt =
      test::limits(trapped.path(), {"learn", "v1", "--plan", "quick", "--per-point"});
  CHECK(std::abs(max_at(trapped, fast) / max_at(clean, fast) - 1) < 0.1);
  CHECK(max_at(trapped, slow) == max_at(clean, slow));
  CHECK_THAT(learnt.out,
             Contains("set aside") && Contains("U07") && Contains("U23") && Contains("U41"));
}

TEST_CASE("a limit for a point that is in force is learnt anew in its place", "[bench][limits]") {
  const ScratchFolder root;
  enter(root, peaks(), three_times(peaks()));
  CHECK(test::limits(root.path(), {"learn", "v0", "--plan", "quick", "--per-point"}).code == 0);
  CHECK(test::limits(root.path(), {"approve", "v0", "--yes"}).code == 0);
  CHECK(test::limits(root.path(), {"activate", "v0"}).code == 0);
  const auto before = peak_limits(root, "v0");
  REQUIRE(before.size() == 3);
  // Those in force are learnt, the general one and the two of points.
  const test::CommandAnswer again = test::limits(root.path(), {"learn", "v1", "--plan", "quick"});
  CHECK(again.code == 0);
  REQUIRE(peak_limits(root, "v1").size() == 3);
  CHECK(max_at(root, slow) == before[1].max);
  CHECK(max_at(root, {}) == Approx(max_at(root, fast)));
  // A point has the stricter of its own and the general limit in force.
  CHECK_THAT(again.out, Contains("0.0 % of 50 judged runs would change"));
}

TEST_CASE("what no unit shows at any point makes no draft", "[bench][limits]") {
  const ScratchFolder root;
  CHECK(test::limits(root.path(), {"learn", "v1", "--plan", "quick", "--per-point"}).code == 20);
  CHECK_FALSE(std::filesystem::exists(limits_path(root.path(), "v1")));
  const test::CommandAnswer none = test::limits(
      root.path(), {"learn", "v1", "--plan", "quick", "--per-point", "--measure", "lost_motion"});
  CHECK(none.code == 20);
  CHECK_FALSE(std::filesystem::exists(limits_path(root.path(), "v1")));
}

}  // namespace rvbench::bench
