#include <catch2/catch.hpp>
#include <iostream>

#include "analysis/tpa/linear_phase_filters.hpp"
#include "analysis/tpa/path_histories.hpp"
#include "tests/support/under_sanitizer.hpp"
#include "tests/tpa/robot_study.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using Eigen::Index;

namespace {

// A hit is recorded until the arm is at rest.
const LineGrid quarter_hertz{5, 0.25, 1981};

sim::RobotOptions robot_of(std::uint64_t seed) {
  sim::RobotOptions options;
  options.seed = seed;
  options.hit_s = 1 / quarter_hertz.step_Hz;
  options.hits = 10;
  options.threads = 1;
  return options;
}

std::vector<test::RobotStudy> studies_of(const sim::VirtualRobot& robot, const FrfMatrix& frfs,
                                         const std::vector<std::string>& rules) {
  std::vector<test::RobotStudy> studies;
  test::study_robot(robot, frfs, quarter_hertz, rules, studies);
  return studies;
}

void print(const std::string& name, const test::RobotStudy& study) {
  std::cout << name << ": leaders " << study.leaders_right << " of " << study.cases
            << ", contributions " << study.within << " of " << study.contributions << ", worst off "
            << 100 * study.worst_rms << " % and " << study.worst_phase_deg
            << " degrees, least score " << study.worst_score << ", forces within "
            << 100 * study.worst_force << " %, where ill-conditioned "
            << 100 * study.worst_ill_force << " %" << std::endl;
}

}  // namespace

TEST_CASE("a hammer test and an operation tell who leads at each target of the virtual robot",
          "[tpa][robot]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::VirtualRobot robot(robot_of(1));
  const FrfMatrix measured = test::measured_frfs(robot, quarter_hertz);
  const test::RobotStudy study =
      studies_of(robot, test::prepared(measured), {"tikhonov_by_gcv"}).front();
  CHECK(study.cases == 9);
  CHECK(study.leaders_right == 9);
  CHECK(study.worst_score >= 0.95);
  CHECK(study.worst_force <= 0.1);
  // Not all are: noise of the sensors, where a line of the forces meets a resonance.
  CHECK(double(study.within) >= 0.95 * study.contributions);

  // On the same hits and records: the FRFs' noise goes through the small singular values.
  const test::RobotStudy plain = studies_of(robot, measured, {"none"}).front();
  CHECK(plain.within < study.within);
  CHECK(plain.worst_ill_force > 1.5 * study.worst_ill_force);
}

TEST_CASE("plain inversion invents forces where the matrix is ill-conditioned", "[tpa][robot]") {
  const sim::VirtualRobot robot(robot_of(2));
  const sim::Operation operation = sim::operate(robot, sim::RobotMotion::straight_slow);
  const LineGrid quiet{5, 0.25, 9};  // below all lines of the forces
  const auto error = [&](const char* rule) {
    const auto found = matrix_inverse_contributions(
        test::exact_frfs(robot, quiet), test::spectra_of(robot, operation.recording, quiet),
        test::robot_roles(robot), find_rule(rule)->rule, {}, 1);
    CHECK(found.conditions.minCoeff() > 100);
    return test::force_error(
        found.forces, test::spectra_of(operation.truth.forces_N, robot.options().rate_Hz, quiet),
        found.conditions, {100, 1e12});
  };
  // Off by more than if it said that there are none.
  CHECK(error("none") > 1);
  CHECK(error("tikhonov_by_evidence") < 1);
}

TEST_CASE("force histories of the virtual robot are its own, the article's filters lose them",
          "[tpa][robot]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::VirtualRobot robot(robot_of(3));
  const double rate_Hz = robot.options().rate_Hz;
  const sim::Operation operation = sim::operate(robot, sim::RobotMotion::straight_slow);
  const FrfMatrix frfs = test::exact_frfs(robot, quarter_hertz);
  const auto found = matrix_inverse_contributions(
      frfs, test::spectra_of(robot, operation.recording, quarter_hertz), test::robot_roles(robot),
      find_rule("tikhonov_by_gcv")->rule, {}, 1);
  const Eigen::MatrixXd inputs = test::samples_of(operation.recording, found.inputs);
  const auto off = [&](const Eigen::MatrixXd& forces_N) {
    // Away from both ends: filters of 4 s reach back 3 s, and 1 s ahead.
    const Index from = Index(3 * rate_Hz), rows = Index(16 * rate_Hz);
    const auto spectra = [&](const Eigen::MatrixXd& histories) {
      return test::spectra_of(histories.middleRows(from, rows), rate_Hz, quarter_hertz);
    };
    return test::force_error(spectra(forces_N), spectra(operation.truth.forces_N), found.conditions,
                             test::well_conditioned);
  };
  const auto histories = path_histories(found, inputs, rate_Hz);
  REQUIRE(histories);
  CHECK(off(histories->forces) < 0.1);
  const FirMatrix linear_phase =
      linear_phase_filters(found.to_forces, quarter_hertz.first_Hz, quarter_hertz.step_Hz, rate_Hz);
  CHECK(off(test::filtered(linear_phase, inputs)) > 0.5);
}

TEST_CASE("20 virtual robots", "[.tpa20]") {
  test::RobotStudy sums, plain_sums;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const sim::VirtualRobot robot(robot_of(seed));
    const FrfMatrix measured = test::measured_frfs(robot, quarter_hertz);
    const std::string of_seed = "seed " + std::to_string(seed) + ", ";
    const auto plain = studies_of(robot, measured, {"none"}).front();
    print(of_seed + "plain inversion of what was measured", plain);
    const auto study = studies_of(robot, test::prepared(measured), {"tikhonov_by_gcv"}).front();
    print(of_seed + "smoothed, aligned, tikhonov_by_gcv", study);
    plain_sums.add(plain);
    sums.add(study);
  }
  print("all, plain inversion of what was measured", plain_sums);
  print("all, smoothed, aligned, tikhonov_by_gcv", sums);
}

TEST_CASE("rules on one virtual robot", "[.tpa_rules]") {
  const std::vector<std::string> rules{"tikhonov_by_gcv",         "tikhonov_by_evidence",
                                       "truncation_by_l_curve",   "truncation_by_noise",
                                       "truncation_by_condition", "none"};
  const sim::VirtualRobot robot(robot_of(1));
  const auto studies =
      studies_of(robot, test::prepared(test::measured_frfs(robot, quarter_hertz)), rules);
  for (std::size_t i = 0; i < rules.size(); ++i) print(rules[i], studies[i]);
}
