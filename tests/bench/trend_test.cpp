#include "bench/results/trend.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "bench/result_database.hpp"
#include "bench/results/history_table.hpp"
#include "bench/results/run_filter.hpp"
#include "bench/text_file.hpp"
#include "tests/bench/answers.hpp"
#include "tests/bench/entered_run.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

namespace {

// Twelve runs, one a day, of two units in turn; band_rms of the meshes rises by 0.1 m/s² a day.
void enter_twelve(const ScratchFolder& root) {
  for (int day = 1; day <= 12; ++day) {
    Judgement judgement = day % 4 == 0 ? test::failed_run() : test::passed_run();
    judgement.facts.serial = day % 2 == 0 ? "B" : "A";
    judgement.facts.started_utc = fmt::format("202601{:02}T120000Z", day);
    judgement.points[0].examination.channels[0].indicators[2].value = 1 + 0.1 * day;
    test::enter_run(root.path(), judgement);
  }
}

test::CommandAnswer trend(const ScratchFolder& root, std::vector<std::string> words) {
  words.insert(words.begin(), "trend");
  words.insert(words.end(), {"--runs", root.path().string()});
  return test::rvbench(words);
}

test::CommandAnswer history(const ScratchFolder& root, std::vector<std::string> words) {
  words.insert(words.begin(), "history");
  words.insert(words.end(), {"--out", root.path().string(), "--json"});
  return test::rvbench(words);
}

std::size_t runs_in(const test::CommandAnswer& answer) {
  return nlohmann::json::parse(answer.out).at("runs").size();
}

}  // namespace

TEST_CASE("a rise that is there is told with its slope and interval", "[bench][results]") {
  const ScratchFolder root;
  enter_twelve(root);
  const auto told = trend(root, {"band_rms", "--of", "sun-planet mesh", "--json"});
  CHECK(told.code == 0);
  const auto json = nlohmann::json::parse(told.out);
  CHECK(json.at("values").size() == 12);
  CHECK(json.at("unit") == "m/s²");
  CHECK(json.at("trend").at("told") == true);
  CHECK(json.at("trend").at("slope_per_day").get<double>() == Approx(0.1));
  CHECK(json.at("values").at(0).at("channel") == "accel_1x");
  const auto text = trend(root, {"band_rms", "--of", "sun-planet mesh"}).out;
  CHECK_THAT(text, Contains("rises by 3 m/s² per 30 days") && Contains("▁") && Contains("█"));
  // Without --of the worst of all bands, which is that of the meshes.
  CHECK(nlohmann::json::parse(trend(root, {"band_rms", "--json"}).out).at("values") ==
        json.at("values"));
}

TEST_CASE("trend --last tells of the newest runs alone, and of all where there are not so many",
          "[bench][results]") {
  const ScratchFolder root;
  enter_twelve(root);
  const auto values = [&](const std::string& last) {
    return nlohmann::json::parse(trend(root, {"band_rms", "--last", last, "--json"}).out)
        .at("values");
  };
  CHECK(values("10").size() == 10);
  CHECK(values("10").back() == values("12").back());
  CHECK(values("12").size() == 12);
  CHECK(values("13").size() == 12);
  CHECK(trend(root, {"band_rms", "--last", "0"}).code == 2);
}

TEST_CASE("what does not move, and what too few runs show, is told as no trend",
          "[bench][results]") {
  const ScratchFolder root;
  enter_twelve(root);
  CHECK_THAT(trend(root, {"kurtosis"}).out, Contains("no trend can be told: 0 per 30 days"));
  CHECK_THAT(trend(root, {"band_rms", "--serial", "A"}).out,
             Contains("no trend can be told: 6 runs, 10 are needed"));
  CHECK_THAT(trend(root, {"band_rms", "--channel", "accel_9x"}).out, Contains("no run has it"));
  CHECK_THAT(trend(root, {"band_rms", "--point", "1210/100"}).out, Contains("no run has it"));
  CHECK_THAT(trend(root, {"band_rms", "--point", "605/100"}).out, Contains("rises"));
}

TEST_CASE("the depth of a part is followed through findings", "[bench][results]") {
  const ScratchFolder root;
  enter_twelve(root);
  const auto json =
      nlohmann::json::parse(trend(root, {"modulation_depth", "--of", "input_shaft", "--json"}).out);
  CHECK(json.at("values").size() == 3);  // of the other runs no finding says anything of it
  CHECK(json.at("values").at(0).at("value") == 0.6);
  // Of all points and channels together: one of them has none.
  for (const auto& [option, value] : {std::pair{"--point", "1210/50"}, {"--channel", "accel_1x"}}) {
    const test::CommandAnswer answer = trend(root, {"modulation_depth", option, value});
    CHECK(answer.code == 2);
    CHECK_THAT(answer.err, Contains("from all points and channels together"));
  }
}

TEST_CASE("the worst of all is the worst of the points and of the channels", "[bench][results]") {
  const ScratchFolder root;
  {
    Judgement judgement = test::passed_run();
    judgement.points.resize(2, judgement.points.front());
    judgement.points[1].planned_speed_rpm = 1815;
    for (std::size_t p = 0; p < 2; ++p) {
      auto& channels = judgement.points[p].examination.channels;
      channels.resize(2, channels.front());
      channels[1].name = "accel_1y";
      for (std::size_t c = 0; c < 2; ++c) channels[c].indicators[0].value = double(3 + 2 * p + c);
    }
    test::enter_run(root.path(), judgement);
  }
  const auto kurtosis = [&](SeriesOf asked) {
    asked.measure = "kurtosis";
    return ResultDatabase::open(root.path()).value().series(asked).value().at(0);
  };
  CHECK(kurtosis({}).value == 6);
  CHECK(kurtosis({}).point == 1);
  CHECK(kurtosis({}).channel == "accel_1y");
  CHECK(kurtosis({.least = true}).value == 3);
  CHECK(kurtosis({.least = true}).channel == "accel_1x");
  CHECK(kurtosis({.at = {605, std::nullopt}}).value == 4);
  CHECK(kurtosis({.channel = "accel_1x"}).value == 5);
  CHECK(kurtosis({.at = {1815, 100}, .channel = "accel_1x", .least = true}).value == 5);
}

TEST_CASE("trend says what is wrong with its arguments", "[bench][results]") {
  const ScratchFolder root;
  CHECK_THAT(trend(root, {"kurtosiss"}).err, Contains("did you mean \"kurtosis\"?"));
  const auto point = trend(root, {"kurtosis", "--point", "1210"});
  CHECK(point.code == 2);
  CHECK_THAT(point.err, Contains("state speed and load as 1210/50"));
  for (const char* no_point : {"nan/50", "1210/nan", "inf/50", "1e308/50", "1210/1e308", "-1/50"}) {
    CAPTURE(no_point);
    CHECK(trend(root, {"kurtosis", "--point", no_point}).code == 2);
  }
  CHECK(test::rvbench({"trend", "kurtosis", "--runs", (root / "no").string()}).code == 2);
}

TEST_CASE("the page of a trend has plot, sentence and values, and is not written over",
          "[bench][results]") {
  const ScratchFolder root;
  enter_twelve(root);
  const std::string out = (root / "page").string();
  CHECK(trend(root, {"band_rms", "--out", out}).code == 0);
  const std::string page = read_file(root / "page" / "trend.html").value();
  CHECK_THAT(page, Contains("<svg") && Contains("rises by 3") && Contains("2026-01-12 12:00:00"));
  CHECK(nlohmann::json::accept(read_file(root / "page" / "trend.json").value()));
  CHECK(trend(root, {"band_rms", "--out", out}).code == 2);
}

TEST_CASE("the strip shows least and greatest, and a lone peak among many", "[bench][results]") {
  CHECK(strip_of({}, 10).empty());
  CHECK(strip_of({0, 1}, 10) == "▁█");
  CHECK(strip_of({5, 5}, 10) == "▁▁");
  std::vector<double> many(100, 0.0);
  many[37] = 1;
  CHECK_THAT(strip_of(many, 10), Contains("▁▁▁█▁▁▁▁▁▁"));
}

TEST_CASE("history is narrowed by time, verdict, plan, part, indicator and number",
          "[bench][results]") {
  const ScratchFolder root;
  enter_twelve(root);
  CHECK(runs_in(history(root, {})) == 12);
  CHECK(runs_in(history(root, {"--from", "2026-01-10"})) == 3);
  CHECK(runs_in(history(root, {"--to", "2026-01-02"})) == 2);
  CHECK(runs_in(history(root, {"--to", "2026-01-02 11:59"})) == 1);
  CHECK(runs_in(history(root, {"--from", "2026-01-04", "--to", "2026-01-04"})) == 1);
  CHECK(runs_in(history(root, {"--verdict", "FAIL"})) == 3);
  CHECK(runs_in(history(root, {"--plan", "quick"})) == 12);
  CHECK(runs_in(history(root, {"--plan", "slow"})) == 0);
  CHECK(runs_in(history(root, {"--component", "input_shaft"})) == 3);
  CHECK(runs_in(history(root, {"--component", "sun_gear"})) == 0);  // not above its limit
  CHECK(runs_in(history(root, {"--indicator", "lost_motion"})) == 0);
  const auto last = history(root, {"--indicator", "band_rms", "--serial", "B", "--last", "2"});
  const auto runs = nlohmann::json::parse(last.out).at("runs");
  REQUIRE(runs.size() == 2);
  CHECK(runs[1].at("started_utc") == "20260112T120000Z");
  CHECK(runs[1].at("indicator").at("value").get<double>() == Approx(2.2));
  const auto bad = history(root, {"--from", "yesterday"});
  CHECK(bad.code == 2);
  CHECK_THAT(bad.err, Contains("--from \"yesterday\": no time as 2026-11-21"));
  CHECK(history(root, {"--from", "2026-02-30"}).code == 2);
  CHECK(history(root, {"--indicator", "loudness"}).code == 2);
}

TEST_CASE("days are counted from the epoch, in any way a time is written", "[bench][results]") {
  CHECK(days_of_utc("19700102T060000Z").value() == 1.25);
  CHECK(days_of_utc("20000301T000000Z").value() == 11017);  // `date -d 2000-03-01 +%s` / 86400
  CHECK_FALSE(days_of_utc("20261301T000000Z"));
  CHECK_FALSE(days_of_utc("first"));
  CHECK(utc_of_text("2026-11-21", true) == "20261121T235959Z");
  CHECK(utc_of_text("20261121T114559Z", false) == "20261121T114559Z");
  CHECK_FALSE(utc_of_text("2026-11", false));
}

TEST_CASE("history keeps to the width of a terminal, and cuts neither serial nor verdict",
          "[bench][results]") {
  const std::string reason =
      "input_shaft: unbalance, acceleration_peak 0.31 g is above 0.25 g at 1210 rpm, 50 % load";
  RunRow row;
  row.started_utc = "20260102T030405Z";
  row.serial = GENERATE(as<std::string>{}, "A17", "RV20E-000123-" + std::string(24, '7'));
  row.plan = "rv20e_acceptance_of_a_long_name";
  row.verdict = "INVALID";
  row.reason = reason;
  const History history{{row}, {}, {}};
  const auto told = [&](int columns) {
    std::ostringstream out;
    Console console{out, out};
    console.out_columns = columns;
    print_history(console, history);
    return out.str();
  };
  CHECK_THAT(told(0), Contains(reason) && Contains(row.plan));  // a pipe gets all in one line
  for (const int columns : {80, 100, 132}) {
    CAPTURE(columns);
    const std::string text = told(columns);
    std::istringstream lines(text), words(text);
    for (std::string line; std::getline(lines, line);) CHECK(shown_width(line) <= columns);
    CHECK_THAT(text, Contains(row.serial + " ") && Contains("INVALID"));
    std::string joined;
    for (std::string word; words >> word;) joined += word + " ";
    CHECK_THAT(joined, Contains(reason));
  }
}

}  // namespace rvbench::bench
