#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/signals.hpp"

// `chart`: values in the order of time in, whether anything but chance shows out.
namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;
using rvbench::test::white_noise;
using test::CommandAnswer;
using test::rvbench;

// Lost motion of about 0.8 arcmin.
Eigen::VectorXd lost_motion(Eigen::Index count) {
  return 0.8 + 0.02 * white_noise(count, 21).array();
}

std::string file_of(const ScratchFolder& scratch, const Eigen::VectorXd& values) {
  std::string text = "run,value [arcmin]\n";
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    text += fmt::format("A{},{:.6g}\n", i + 1, values[i]);
  }
  const auto file = scratch / "chart.csv";
  write_file(file, text);
  return file.string();
}

nlohmann::json told(std::vector<std::string> words) {
  words.insert(words.begin(), "chart");
  words.emplace_back("--json");
  return nlohmann::json::parse(rvbench(words).out);
}

std::string chart_refusal(const std::string& text) {
  const ScratchFolder scratch;
  write_file(scratch / "chart.csv", text);
  const CommandAnswer answer = rvbench({"chart", (scratch / "chart.csv").string()});
  CHECK(answer.code == 20);
  CHECK(answer.out.empty());
  return answer.err;
}

}  // namespace

TEST_CASE("values of chance alone are in control, and said to fit", "[bench][station]") {
  const ScratchFolder scratch;
  const std::string file = file_of(scratch, lost_motion(30));
  const CommandAnswer answer =
      rvbench({"chart", file, "--upper", "1", "--rules", "western_electric"});
  INFO(answer.out);
  CHECK(answer.code == 0);
  CHECK_THAT(answer.out, Contains("IN CONTROL  Nothing but chance shows in 30 values.") &&
                             !Contains("OUT OF") && Contains("arcmin; from 30 values") &&
                             Contains("Cpk ") && Contains("Ppk ") && !Contains("Cp  ") &&
                             !Contains("not normal"));
  const auto json = told({file, "--upper", "1", "--rules", "western_electric"});
  CHECK(json.at("verdict") == "in_control");
  CHECK(json.at("signals").empty());
  CHECK(json.at("warnings").empty());
  CHECK(json.at("capability").at("cp").is_null());
  CHECK(json.at("capability").at("cpk").at("value").get<double>() > 2);
  CHECK(told({file}).at("capability").is_null());
}

TEST_CASE("a jump after the baseline is told with run and rule", "[bench][station]") {
  const ScratchFolder scratch;
  Eigen::VectorXd values = lost_motion(26);
  values[25] = 1.1;
  const std::string file = file_of(scratch, values);
  const auto json = told({file, "--baseline", "25"});
  CHECK(json.at("verdict") == "out_of_control");
  CHECK(json.at("baseline").at("values") == 25);
  CHECK(json.at("newest").at("at") == "A26");
  CHECK(json.at("newest").at("in_control") == false);
  CHECK(json.at("newest").at("rules") ==
        nlohmann::json::array({"nelson_1", "moving_range", "ewma"}));
  CHECK_THAT(rvbench({"chart", file, "--baseline", "25"}).out,
             Contains("OUT OF CONTROL  First at A26: beyond 3 sigma (nelson_1). 3 such signals") &&
                 Contains("A26  1.1  moving_range"));
}

TEST_CASE("what an index is not worth is told", "[bench][station]") {
  const ScratchFolder scratch;
  Eigen::VectorXd values = white_noise(15, 5).array().exp();
  values[7] = 60;
  const std::string file = file_of(scratch, values);
  const CommandAnswer answer = rvbench({"chart", file, "--lower", "-5", "--upper", "100"});
  CHECK_THAT(answer.out, Contains("The baseline has 15 values: its limits are uncertain") &&
                             Contains("The values are not normal") &&
                             Contains("The process is not in control") && Contains("Cp ") &&
                             Contains("Pp "));
}

TEST_CASE("the folder of --out holds the charts", "[bench][station]") {
  const ScratchFolder scratch;
  Eigen::VectorXd values = lost_motion(40);
  values[33] = 1.2;
  const std::string file = file_of(scratch, values), out = (scratch / "charted").string();
  CHECK(rvbench({"chart", file, "--upper", "1", "--out", out}).code == 0);
  const std::string page = read_file(scratch / "charted/chart.html").value();
  CHECK_THAT(page, Contains("Individuals") && Contains("Moving ranges") && Contains("EWMA") &&
                       Contains("nelson_1") && Contains("A34") && Contains("value [arcmin]") &&
                       Contains("Cpk") && !Contains("nan"));
  CHECK(nlohmann::json::parse(read_file(scratch / "charted/chart.json").value()).at("values") ==
        40);
  CHECK_THAT(rvbench({"chart", file, "--out", out}).err, Contains("holds a chart.json already"));
}

TEST_CASE("a table that makes no chart is refused, with the place", "[bench][station]") {
  CHECK_THAT(chart_refusal("run,value\n1,2\n2,3\n"),
             Contains("2 values: a chart takes 8 or more, and 20 make a good one"));
  CHECK_THAT(chart_refusal("number,value\n1,2\n"), Contains("no column \"time\" or \"run\""));
  CHECK_THAT(chart_refusal("time,size\n1,2\n"), Contains("no column \"value\""));
  CHECK_THAT(chart_refusal("time,value\n2026-01-02,2\n2026-01-01,3\n"),
             Contains("chart.csv:3: time 2026-01-01 is before 2026-01-02 in the row above"));
  CHECK_THAT(chart_refusal("time,value\n9,2\n10,3\n7,3\n"), Contains("chart.csv:4: time 7 is before 10"));
  CHECK_THAT(chart_refusal("time,value\n10,2\n9.5,3\n"), Contains("chart.csv:3: time 9.5 is before"));
  CHECK_THAT(chart_refusal("time,value\n2026-01-31 08:00:00.25,2\n20260131T080000.125Z,3\n"),
             Contains("chart.csv:3: time 20260131T080000.125Z is before"));
  CHECK_THAT(chart_refusal("time,value\n20260131T080000Z-10,2\n20260131T080000Z-9,3\n"),
             Contains("chart.csv:3: time 20260131T080000Z-9 is before"));
  std::string alike = "run,value\n";
  for (int i = 0; i < 10; ++i) alike += fmt::format("{},1\n", i);
  CHECK_THAT(chart_refusal(alike), Contains("all alike: too coarse"));
}

TEST_CASE("a time that is none is refused at its line", "[bench][station]") {
  const std::string none = GENERATE(
      as<std::string>(), "2026-02-30", "hello0", "2026-01-31T24:01", "31.01.2026", "nan", "7",
      "2026-01-31.5", "2026-01-31T08:00:00.x", "20260131T080000Z-" + std::string(400, '9'), "\"\"");
  CAPTURE(none);
  CHECK_THAT(chart_refusal("time,value\n2026-01-02,2\n" + none + ",3\n2026-03-01T08:00,3\n"),
             Contains("chart.csv:3: time \"") && Contains("\" is none: all are numbers, or dates"));
}

TEST_CASE("values that overflow are no chart and no index", "[bench][station]") {
  const ScratchFolder scratch;
  const auto asked = [&](double large, double small, std::vector<std::string> more) {
    Eigen::VectorXd values(10);
    for (Eigen::Index i = 0; i < 10; ++i) values[i] = i % 2 == 0 ? large : small;
    more.insert(more.begin(), {"chart", file_of(scratch, values)});
    return rvbench(more);
  };
  const CommandAnswer chart = asked(1e308, -1e308, {});
  CHECK(chart.code == 20);
  CHECK(chart.out.empty());
  CHECK_THAT(chart.err, Contains("chart.csv: cannot tell: a limit of the chart is no finite"));
  // The chart of these can be made, but not their squares.
  const CommandAnswer index = asked(1e200, -1e200, {"--upper", "2e200"});
  CHECK(index.code == 20);
  CHECK_THAT(index.err, Contains("cannot tell: the standard deviation is no finite number"));
  CHECK(asked(1e200, -1e200, {}).code == 0);
}

TEST_CASE("limits and baselines that make no sense are refused", "[bench][station]") {
  const ScratchFolder scratch;
  const std::string file = file_of(scratch, lost_motion(20));
  CHECK(rvbench({"chart", file, "--lower", "2", "--upper", "1"}).code == 2);
  CHECK(rvbench({"chart", file, "--baseline", "7"}).code == 2);
  CHECK(rvbench({"chart", file, "--rules", "shewhart"}).code == 2);
  const CommandAnswer answer = rvbench({"chart", file, "--baseline", "21"});
  CHECK(answer.code == 20);
  CHECK_THAT(answer.err, Contains("20 values, and --baseline asks for 21"));
}

}  // namespace rvbench::bench
