#include "bench/population.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "bench/report/report.hpp"
#include "bench/result_database.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;
using rvbench::test::ScratchFolder;

UnitNumber peak(double value, double limit = not_known) {
  return {"acceleration_peak", "", "g", false, value, limit};
}

// Units whose one number is 1, 2, ..., count.
std::vector<EarlierUnit> counted_units(int count, bool passed = true) {
  std::vector<EarlierUnit> units;
  for (int i = 1; i <= count; ++i) units.push_back({"E" + std::to_string(i), passed, {double(i)}});
  return units;
}

Judgement unit_with_peak(const std::string& serial, const std::string& utc, double peak_g) {
  Judgement judgement = test::passed_run();
  judgement.facts.serial = serial;
  judgement.facts.started_utc = utc;
  judgement.limits.front().measured = peak_g;
  auto& channel = judgement.points.front().examination.channels.front();
  channel.indicators = {{"acceleration_peak", "", peak_g, "g"}};
  return judgement;
}

// A run folder as a run leaves it, as far as others look into it.
std::filesystem::path leave_run(const std::filesystem::path& root, const Judgement& judgement) {
  const RunFacts& facts = judgement.facts;
  const auto folder = create_run_folder(root, facts.serial, facts.started_utc);
  write_file(folder / "start.json", run_begin_to_json({facts.serial, facts.started_utc, 1}));
  write_file(folder / "plan.json", R"({"name": ")" + facts.plan + "\"}");
  write_file(folder / "verdict.json", judgement_to_json(judgement));
  write_sums(folder);
  return folder;
}

std::string html_of(const Population& population) {
  ReportInput input;
  input.judgement = test::passed_run();
  input.population = population;
  const std::string html = make_report(input);
  const auto begin = html.find("<h2>This unit among earlier ones</h2>");
  REQUIRE(begin != std::string::npos);
  return html.substr(begin, html.find("<h2>", begin + 4) - begin);
}

}  // namespace

TEST_CASE("a unit stands where its number lies among those of earlier units", "[bench]") {
  std::vector<EarlierUnit> units = counted_units(29);
  units.push_back({"bad", false, {40}});
  const Population population = population_of({peak(27.5, 35)}, units);
  CHECK(population.passed == 29);
  CHECK(population.failed == 1);
  REQUIRE(population.standings.size() == 1);
  const Standing& standing = population.standings.front();
  CHECK(standing.better == 27);
  CHECK(standing.median == Approx(15.5));  // of 1..29 and 40
  CHECK(standing.failed == std::vector<double>{40});
}

TEST_CASE("where the least is the worst, higher ones are better", "[bench]") {
  const UnitNumber stiffness{"torsional_stiffness", "", "N·m/arcmin", true, 3, not_known};
  CHECK(population_of({stiffness}, counted_units(10)).standings.front().better == 7);
}

TEST_CASE("fewer than eight units are no population", "[bench]") {
  CHECK(population_of({peak(1)}, {}).standings.empty());
  CHECK(population_of({peak(1)}, counted_units(7)).standings.empty());
  CHECK(population_of({peak(1)}, counted_units(8)).standings.size() == 1);
  // Nor are many, of which fewer have that number.
  std::vector<EarlierUnit> units = counted_units(30);
  for (std::size_t i = 7; i < units.size(); ++i) units[i].values = {not_known};
  CHECK(population_of({peak(1)}, units).standings.empty());
}

TEST_CASE("shown are the three nearest to their limits, then the farthest out", "[bench]") {
  const auto named = [](const char* measure, double value, double limit) {
    return UnitNumber{measure, "", "1", false, value, limit};
  };
  std::vector<EarlierUnit> units = counted_units(20);
  for (EarlierUnit& unit : units) unit.values.resize(6, unit.values.front());
  const Population population = population_of(
      {named("far below", 1, 100), named("usual", 10, not_known), named("beyond", 5, 1),
       named("odd", 300, not_known), named("at it", 4, 4), named("near", 3, 4)},
      units);
  std::vector<std::string> names;
  for (const Standing& standing : population.standings) names.push_back(standing.number.measure);
  CHECK(names == std::vector<std::string>{"beyond", "at it", "near", "odd"});
}

TEST_CASE("a unit of another count of numbers is the caller's bug", "[bench]") {
  CHECK_THROWS_AS(population_of({peak(1), peak(2)}, counted_units(8)), std::invalid_argument);
}

TEST_CASE("a unit is compared by its limits, by parts above the noise, and by what has no limit",
          "[bench]") {
  const auto numbers = numbers_of(test::failed_run());
  const auto find = [&](const std::string& name) {
    const auto at = std::ranges::find(numbers, name, [](const auto& n) { return name_of(n); });
    return at == numbers.end() ? UnitNumber{} : *at;
  };
  CHECK(find("acceleration_peak").value == Approx(1.9));
  CHECK(share_of_limit(find("acceleration_peak")) == Approx(3.8));  // of 0.5 g
  CHECK(find("modulation_depth of input_shaft: misalignment").value == Approx(0.6));
  CHECK(find("band_rms").value == Approx(1.5));  // m/s², the worst band
  CHECK(std::isnan(find("band_rms").limit));
  CHECK(find("modulation_depth of sun_gear: profile_error").measure.empty());  // below the noise
}

TEST_CASE("another unit's number is in the unit asked for, and a silent part is at zero",
          "[bench]") {
  Judgement other = test::passed_run();
  auto& channel = other.points.front().examination.channels.front();
  channel.indicators = {{"acceleration_peak", "", 9.80665, "m/s²"}};
  CHECK(value_in(other, peak(0)) == Approx(1));  // g
  const UnitNumber depth{"modulation_depth", "sun_gear: profile_error", "1", false, 0.3, 0.1};
  CHECK(value_in(other, depth) == 0);
  other.diagnosis.not_shown.front().severity_high = 0.5;  // noise could hide more than the limit
  CHECK(std::isnan(value_in(other, depth)));
  CHECK(std::isnan(value_in(other, {"modulation_depth", "motor: unbalance", "1", false, 0.3})));
}

TEST_CASE("earlier units are the last sound runs of others by the same plan", "[bench]") {
  const ScratchFolder root;
  const Judgement own = unit_with_peak("own", "20260105T000000Z", 0.5);
  const auto folder = leave_run(root.path(), own);
  const auto earlier = [&] {
    std::vector<double> values;
    for (const EarlierUnit& unit : earlier_units(folder, own, {peak(0.5)})) {
      values.push_back(unit.values.front());
    }
    return values;
  };
  CHECK(earlier().empty());
  leave_run(root.path(), unit_with_peak("own", "20260101T000000Z", 9));  // itself, before
  leave_run(root.path(), unit_with_peak("later", "20260106T000000Z", 9));
  Judgement other = unit_with_peak("other plan", "20260101T000000Z", 9);
  other.facts.plan = "rv20e_acceptance";
  leave_run(root.path(), other);
  other = unit_with_peak("other machine", "20260101T000000Z", 9);
  other.machine = "RV-40E";
  leave_run(root.path(), other);
  other = unit_with_peak("untrusted", "20260101T000000Z", 9);
  other.ending.outcome = Outcome::invalid;
  leave_run(root.path(), other);
  write_file(root.path() / "results.db", "no folder");
  CHECK(earlier().empty());

  leave_run(root.path(), unit_with_peak("a", "20260101T000000Z", 0.1));
  leave_run(root.path(), unit_with_peak("b", "20260102T000000Z", 0.2));
  leave_run(root.path(), unit_with_peak("a", "20260103T000000Z", 0.3));
  other = unit_with_peak("a", "20260104T000000Z", 9);  // a retest that says nothing
  other.ending.outcome = Outcome::error;
  leave_run(root.path(), other);
  CHECK(earlier() == std::vector<double>{0.3, 0.2});  // the latest first

  remove_sums(root.path() / "b" / "20260102T000000Z");  // not whole
  CHECK(earlier() == std::vector<double>{0.3});
}

TEST_CASE("earlier units are those that the database of results names", "[bench]") {
  const ScratchFolder root;
  const Judgement own = unit_with_peak("own", "20260105T000000Z", 0.5);
  const auto folder = leave_run(root.path(), own);
  leave_run(root.path(), unit_with_peak("a", "20260101T000000Z", 0.1));
  leave_run(root.path(), unit_with_peak("b", "20260102T000000Z", 0.2));
  const auto values = [&] {
    std::vector<double> all;
    for (const EarlierUnit& unit : earlier_units(folder, own, {peak(0.5)})) {
      all.push_back(unit.values.front());
    }
    return all;
  };
  const std::vector<double> from_folders = values();
  CHECK(from_folders == std::vector<double>{0.2, 0.1});
  CHECK_FALSE(std::filesystem::exists(root / "results.db"));  // a report makes none
  REQUIRE(caught_up(ResultDatabase::open(root.path())));
  CHECK(values() == from_folders);
  // It is not asked anew how a run began that was entered.
  write_file(root / "b/20260102T000000Z/start.json",
             run_begin_to_json({"b", "20260109T000000Z", 1}));
  CHECK(values() == from_folders);
  // One that nobody has entered is entered.
  leave_run(root.path(), unit_with_peak("c", "20260103T000000Z", 0.3));
  CHECK(values() == std::vector<double>{0.3, 0.2, 0.1});
}

TEST_CASE("a run folder that lies elsewhere has no earlier units", "[bench]") {
  const ScratchFolder root;
  const Judgement own = unit_with_peak("own", "20260105T000000Z", 0.5);
  leave_run(root.path(), unit_with_peak("a", "20260101T000000Z", 0.1));
  const auto folder = leave_run(root.path(), own);
  CHECK(earlier_units(folder, own, {}).size() == 1);
  std::filesystem::rename(root.path() / "own", root.path() / "archive");
  CHECK(earlier_units(root.path() / "archive" / folder.filename(), own, {}).empty());
}

TEST_CASE("the report shows a unit among 30, and says so of 0 and 7", "[bench]") {
  CHECK_THAT(html_of({}),
             Contains("No population yet: 0 earlier units of plan quick, and it takes 8") &&
                 !Contains("<svg"));
  CHECK_THAT(html_of(population_of({peak(3)}, counted_units(7))),
             Contains("No population yet: 7 earlier units") && !Contains("<svg"));
  const std::string html = html_of(population_of({peak(28.4, 35)}, counted_units(30)));
  CHECK_THAT(html, Contains("n = 30 earlier units of plan quick, of which 30 passed and 0 failed"));
  CHECK_THAT(html, Contains("g; n = 30 earlier units, 28 of them lower, median 15.5") &&
                       Contains("this unit 28.4") && Contains("limit 35"));
  std::size_t dots = 0;
  for (auto at = html.find("<circle"); at != std::string::npos; at = html.find("<circle", at + 1)) {
    ++dots;
  }
  CHECK(dots == 30);
}

TEST_CASE("a unit of which nothing is said is compared with none", "[bench]") {
  ReportInput input;
  input.judgement = test::passed_run();
  input.judgement.ending.outcome = Outcome::invalid;
  input.population = population_of({peak(3)}, counted_units(30));
  // The dots would say what the verdict does not.
  input.population.standings.clear();
  CHECK_THAT(make_report(input), Contains("Not compared with earlier units"));
}

}  // namespace rvbench::bench
