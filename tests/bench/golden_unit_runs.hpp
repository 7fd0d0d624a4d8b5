#pragma once

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "bench/qualification/golden_evidence.hpp"
#include "bench/qualification/golden_runs.hpp"
#include "bench/qualification/qualification.hpp"
#include "bench/run_folder.hpp"
#include "bench/sha256.hpp"
#include "bench/text_file.hpp"
#include "bench/verdict_json.hpp"
#include "tests/bench/judgements.hpp"
#include "tests/support/scratch_folder.hpp"

/// A golden unit that is asked for, and its runs in a folder.
namespace rvbench::test {

inline bench::GoldenUnitDemand demand() {
  bench::GoldenUnitDemand demand;
  demand.serial = "GOLD";
  demand.plan = "quick";
  demand.max_age_h = 24;
  demand.indicators = {{"kurtosis"}};
  return demand;
}

inline bench::GoldenUnitDemand of_a_week() {
  bench::GoldenUnitDemand asked = demand();
  asked.max_age_h = 24 * 7;
  return asked;
}

// Of the station that is asked.
inline bench::QualificationSection section(const bench::GoldenUnitDemand& asked) {
  bench::QualificationSection section;
  section.station = "EOL 3";
  section.rig_kind = "bench";
  section.golden_unit = asked;
  return section;
}

// Where its runs were made.
struct Place {
  std::string rig_kind = "bench";
  std::string station = "EOL 3";
};

// Its runs, one a day from 1 January on, of one point at 605 rpm and 100 %.
class GoldenRuns {
 public:
  void enter(
      double kurtosis, const std::function<void(bench::Judgement&)>& change = [](auto&) {}) {
    bench::Judgement judgement = of_today(kurtosis);
    change(judgement);
    begin(judgement.facts);
    end(judgement);
  }

  bench::Judgement of_today(double kurtosis) const {
    bench::Judgement judgement = passed_run();
    judgement.facts.serial = "GOLD";
    judgement.facts.started_utc = fmt::format("202601{:02}T120000Z", day_ + 1);
    judgement.points[0].examination.channels[0].indicators[0].value = kurtosis;
    return judgement;
  }

  void begin(const bench::RunFacts& facts) {
    newest_ = bench::create_run_folder(root_.path(), facts.serial, facts.started_utc);
    bench::write_file(newest_ / "start.json",
                      bench::run_begin_to_json({facts.serial, facts.started_utc, ++day_}));
    bench::write_file(
        newest_ / "rig.json",
        fmt::format(R"({{"rig": "{}", "qualification": {{"station": "{}", "golden_unit": )"
                    R"({{"serial": "{}", "plan": "{}"}}}}}})",
                    place_.rig_kind, place_.station, facts.serial, facts.plan));
    bench::write_file(newest_ / "plan.json", R"({"name": ")" + facts.plan + "\"}");
    bench::write_file(newest_ / "recording.h5", "");
    go_on(facts);
  }

  void end(const bench::Judgement& judgement) {
    bench::write_file(newest_ / "verdict.json", bench::judgement_to_json(judgement));
    bench::write_sums(newest_);
    const bench::QualificationSection here = section_of(judgement.facts);
    REQUIRE(bench::enter_golden_end(root_.path(), &here, newest_).empty());
  }

  void go_on(const bench::RunFacts& facts) const {
    const bench::QualificationSection here = section_of(facts);
    REQUIRE(bench::enter_golden_begin(root_.path(), &here, newest_, plan_).empty());
  }

  void move_to(const Place& place) { place_ = place; }
  void take_plan(const std::string& sha256) { plan_ = sha256; }
  std::filesystem::path newest() const { return newest_; }

  // 3 and what chance adds, without a pattern that a rule would see.
  void enter_sound(int count) {
    constexpr std::array off{-1.0, 1.0, 0.5, -0.5, 0.2, -0.8, 0.9, -0.2, 0.6, -0.6};
    for (int i = 0; i < count; ++i) enter(3 + 0.1 * off[static_cast<std::size_t>(i) % off.size()]);
  }

  std::vector<std::string> reasons(const bench::GoldenUnitDemand& asked,
                                   double hours_later = 1) const {
    const int hours = 12 + static_cast<int>(hours_later);
    const std::string now = fmt::format("202601{:02}T{:02}0000Z", day_ + hours / 24, hours % 24);
    return bench::golden_reasons(bench::gather_evidence(root_.path(), section(asked)).golden, asked,
                                 now);
  }

  const std::filesystem::path& root() const { return root_.path(); }

 private:
  // Of where they are made.
  bench::QualificationSection section_of(const bench::RunFacts& facts) const {
    bench::QualificationSection here = section(demand());
    here.rig_kind = place_.rig_kind;
    here.station = place_.station;
    here.golden_unit->serial = facts.serial;
    here.golden_unit->plan = facts.plan;
    return here;
  }

  ScratchFolder root_;
  Place place_;
  std::filesystem::path newest_;
  std::string plan_ = "of the one text";
  int day_ = 0;
};

inline std::string only(const std::vector<std::string>& reasons) {
  REQUIRE(reasons.size() == 1);
  return reasons[0];
}

}  // namespace rvbench::test
