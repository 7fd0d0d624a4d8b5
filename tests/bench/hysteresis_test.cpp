#include <catch2/catch.hpp>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>

#include "bench/judging.hpp"
#include "bench/kinematics_file.hpp"
#include "bench/report/report.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/held_reducer.hpp"
#include "tests/support/scratch_folder.hpp"

// What `judge` and the limits of a plan make of a reducer that was wound to and fro.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::HeldReducer;
using rvbench::test::ScratchFolder;
using test::rvbench;

const HeldReducer& reducer() {
  static const HeldReducer held;
  return held;
}

analysis::Kinematics rv20e() { return std::get<0>(read_kinematics("rv20e")); }

Judgement judged(const HeldReducer& held, const std::vector<sequences::Limit>& limits) {
  Judgement judgement;
  judgement.points = {judge_point(held.recorded(), rv20e(), {})};
  conclude(judgement, rv20e(), limits, {Outcome::pass, ErrorKind::none, "it was read"});
  demand_confirmation(judgement, rv20e());
  return judgement;
}

sequences::Limit at_most(double arcmin) {
  return {"lost_motion", "", "arcmin", arcmin, "the maker's catalogue"};
}

std::string as_csv(const ScratchFolder& scratch, const Recording& record) {
  const auto file = scratch.path() / "wound.csv";
  std::ofstream out(file);
  out << std::setprecision(12) << "input_torque,input_angle\n";
  for (Eigen::Index i = 0; i < record.channels[0].samples.size(); ++i) {
    out << record.channels[0].samples[i] << ',' << record.channels[1].samples[i] << '\n';
  }
  return file.string();
}

}  // namespace

TEST_CASE("judge tells lost motion of a recording, without a vibration in it", "[bench]") {
  const ScratchFolder scratch;
  const std::string file = as_csv(scratch, reducer().recorded());
  const auto answer = rvbench({"judge", file, "--kinematics", "rv20e", "--rate", "500", "--json",
                               "--out", (scratch.path() / "out").string()});
  INFO(answer.err << answer.out.substr(0, 2000));
  REQUIRE(answer.code == 0);
  const auto verdict = nlohmann::json::parse(answer.out);
  CHECK(verdict.at("verdict") == "PASS");
  std::map<std::string, double> told, errors;
  for (const auto& indicator : verdict.at("points").at(0).at("indicators")) {
    told[indicator.at("name")] = indicator.at("values").at("whole");
    errors[indicator.at("name")] = indicator.at("errors").at("whole");
  }
  CHECK(told["lost_motion"] == Approx(1 + 10.02 / 48.87).epsilon(0.01));
  CHECK(told["torsional_stiffness"] == Approx(48.87).epsilon(0.005));
  CHECK(errors["lost_motion"] > 0);
}

TEST_CASE("a limit on lost motion parts good reducers from bad ones", "[bench]") {
  CHECK(judged(reducer(), {at_most(1.5)}).ending.outcome == Outcome::pass);
  const Judgement bad = judged(reducer(), {at_most(1.0)});
  CHECK(bad.ending.outcome == Outcome::fail);
  CHECK_THAT(bad.ending.reason, Contains("lost_motion 1.2 arcmin above its max 1 arcmin"));
  sequences::Limit stiff{"torsional_stiffness", "", "N·m/arcmin", not_known, "ours"};
  stiff.min = 60;
  CHECK(judged(reducer(), {stiff}).ending.outcome == Outcome::fail);
  stiff.min = 45;
  CHECK(judged(reducer(), {stiff}).ending.outcome == Outcome::pass);
}

TEST_CASE("what cannot be told of a reducer is no pass", "[bench]") {
  HeldReducer slipping;
  slipping.brake_Nm = 150;
  const Judgement nothing = judged(slipping, {});
  CHECK(nothing.ending.outcome == Outcome::invalid);
  CHECK_THAT(nothing.ending.reason, Contains("cannot tell"));

  HeldReducer timid;  // what is passed on reaches 75 %: a lost motion, and no stiffness
  timid.peak_Nm = 125;
  CHECK(judged(timid, {at_most(1.5)}).ending.outcome == Outcome::pass);
  sequences::Limit stiff{"torsional_stiffness", "", "N·m/arcmin", not_known, "ours"};
  stiff.min = 45;
  const Judgement untold = judged(timid, {stiff});
  CHECK(untold.ending.outcome == Outcome::invalid);
  CHECK_THAT(untold.ending.reason, Contains("torsional_stiffness could not be measured"));
}

TEST_CASE("the verdict of a hysteresis test is read back, and its report draws the loop",
          "[bench]") {
  const Judgement judgement = judged(reducer(), {at_most(1.5)});
  const auto again = judgement_from_json(judgement_to_json(judgement));
  REQUIRE(again);
  const analysis::Examination& seen = again->points.at(0).examination;
  CHECK(seen.of_hysteresis);
  REQUIRE_FALSE(seen.indicators.empty());
  CHECK(seen.indicators.front().error ==
        Approx(judgement.points[0].examination.indicators.front().error));
  ReportInput input;
  input.judgement = *again;
  input.kinematics = rv20e();
  input.load = [](std::size_t) { return std::optional<Recording>(reducer().recorded()); };
  const std::string html = make_report(input);
  CHECK_THAT(html, Contains("<h2>Hysteresis</h2>") && Contains("torsion at the output [arcmin]") &&
                       Contains("1.2 ± "));
  input.load = [](std::size_t) { return std::optional<Recording>(); };
  CHECK_THAT(make_report(input), !Contains("<h2>Hysteresis</h2>"));
}

TEST_CASE("a plan's specimen says what its torque and ratio are", "[bench]") {
  const analysis::Kinematics own = rv20e();
  CHECK(own.gear_ratio == Approx(121));
  CHECK(own.rated_output_torque_Nm == 167);
  const auto asked = of_specimen(own, {"rv20e", 100, 80});
  CHECK(asked.gear_ratio == 100);
  CHECK(asked.rated_output_torque_Nm == 80);
}

}  // namespace rvbench::bench
