#include "bench/trust.hpp"

#include <catch2/catch.hpp>

#include "tests/bench/judgements.hpp"

namespace rvbench::bench {
namespace {

const char* const clipped = "clipped: 31 samples at full scale";
const char* const shorter = "too short: 3 whole periods";

Judgement with_notes(const std::vector<analysis::QualityNote>& notes) {
  Judgement judgement = test::passed_run();
  judgement.points.front().examination.quality = notes;
  return judgement;
}

}  // namespace

TEST_CASE("each reason why a record cannot be trusted is said, the sensors' before its length",
          "[bench]") {
  const Ending ending = trust_in(
      with_notes({{"a, 1x", clipped, true}, {"a, 1y", clipped, true}, {"a", shorter, true}}));
  CHECK(ending.outcome == Outcome::invalid);
  CHECK(ending.reason == std::string("a, 1x: ") + clipped + "; a: " + shorter);
}

TEST_CASE("one reason is said alone, and what is only noted is none", "[bench]") {
  CHECK(trust_in(with_notes({{"a", shorter, true}, {"a", "speed as given", false}})).reason ==
        std::string("a: ") + shorter);
  CHECK(trust_in(with_notes({{"a", "speed as given", false}})).outcome == Outcome::pass);
  CHECK(trust_in(with_notes({})).outcome == Outcome::pass);
}

TEST_CASE("of many points that cannot be trusted the first is said with their number", "[bench]") {
  Judgement judgement = with_notes({{"a, 1x", clipped, true}});
  judgement.points.resize(3, judgement.points.front());
  judgement.points.back().examination.quality.clear();
  CHECK(trust_in(judgement).reason ==
        std::string("2 of 3 points cannot be trusted; first a, 1x: ") + clipped);
}

}  // namespace rvbench::bench
