#include <catch2/catch.hpp>
#include <iostream>

#include "analysis/tpa/contribution_ranking.hpp"
#include "tests/analysis/tpa/robot_study.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

const LineGrid half_hertz{5, 0.5, 991};

test::RobotStudy study_of(const std::string& rule, std::uint64_t seed) {
  sim::RobotOptions options;
  options.seed = seed;
  options.threads = 1;
  test::RobotStudy study;
  test::study_robot(options, {}, rule, half_hertz, study);
  return study;
}

}  // namespace

TEST_CASE("the virtual robot's leading paths, its forces and its forearm are found",
          "[tpa][robot]") {
  const test::RobotStudy study = study_of("truncation_by_l_curve", 1);
  CHECK(study.cases == 9);
  CHECK(study.leaders_right == 9);
  CHECK(study.worst_score >= 0.95);
  CHECK(study.worst_force <= 0.1);
}

TEST_CASE("20 virtual robots", "[.twenty]") {
  for (const NamedRule& rule : regularisation_rules()) {
    test::RobotStudy all;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      sim::RobotOptions options;
      options.seed = seed;
      options.threads = 1;
      test::study_robot(options, {}, std::string(rule.name), half_hertz, all);
    }
    std::cout << rule.name << ": leaders " << all.leaders_right << " of " << all.cases
              << ", contributions " << all.within << " of " << all.contributions
              << ", worst off by " << 100 * all.worst_rms << " % and " << all.worst_phase_deg
              << " degrees, least score " << all.worst_score << ", forces within "
              << 100 * all.worst_force << " %\n";
  }
}
