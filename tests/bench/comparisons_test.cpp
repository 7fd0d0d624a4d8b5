#include "bench/comparisons.hpp"

#include <catch2/catch.hpp>

#include "analysis/explain/explanation.hpp"
#include "tests/bench/moved_slide.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {
namespace {

std::unique_ptr<Twin> twin_of(const Campaign& campaign) {
  auto made = make_twin(test::MovedSlide::plant(), campaign);
  REQUIRE(made.index() == 0);
  return std::get<0>(std::move(made));
}

test::MovedSlide rubbing() {
  test::MovedSlide slide;
  slide.law = [](double, double v) { return v > 0 ? 2.5 : -2.5; };
  return slide;
}

}  // namespace

TEST_CASE("what is shown as unseen was predicted without its condition", "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  const auto twin = twin_of(rubbing().campaign());
  const auto said = analysis::explain(*twin);
  const Comparisons all = compare(*twin, said.selection);
  REQUIRE(all.unseen.size() == 3);  // of three conditions
  for (const UnseenRecord& one : all.unseen) {
    CAPTURE(one.before.record);
    CHECK(one.after.relative_error() < 0.3 * one.before.relative_error());
    // Each condition is there twice: its scatter is the transducer's noise of 0.1 N, of which the
    // band of 40 Hz lets through what lies below it.
    REQUIRE(one.scatter.size() == one.before.measured.size());
    const double rms = one.scatter.norm() / std::sqrt(double(one.scatter.size()));
    CHECK(rms == Approx(1.645 * 0.1 * std::sqrt(40.0 / 250)).epsilon(0.15));
    const auto seen = std::ranges::find(all.after, one.after.record, &Twin::Comparison::record);
    CHECK(one.after.simulated != seen->simulated);
    CHECK(one.after.measured == seen->measured);
  }
}

TEST_CASE("of what was only to be predicted, that is shown as it is", "[bench][explain]") {
  if (test::too_long_under_sanitizer()) return;
  Campaign campaign = rubbing().campaign();
  campaign.records[4].learned_from = false;
  campaign.records[4].condition = campaign.records[4].programme = "another day";
  const auto twin = twin_of(campaign);
  const Comparisons all = compare(*twin, analysis::explain(*twin).selection);
  REQUIRE(all.unseen.size() == 1);
  CHECK(all.unseen[0].after.record == "record 5");
  CHECK(all.unseen[0].scatter.size() == 0);  // nothing repeats it
  const auto seen = std::ranges::find(all.after, "record 5", &Twin::Comparison::record);
  CHECK(all.unseen[0].after.simulated == seen->simulated);
}

}  // namespace rvbench::bench
