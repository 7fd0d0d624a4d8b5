#include <catch2/catch.hpp>
#include <random>

#include "analysis/frf/find_hits.hpp"
#include "analysis/frf/hit_faults.hpp"
#include "tests/analysis/frf/two_masses.hpp"

using namespace rvbench;
using namespace rvbench::analysis;
using test::hit_on;

namespace {

const test::TwoMasses body;
const FrfSetup setup = test::hammer_on_left();

JudgedHit judged(const FrfRecord& record, HitLimits limits = {}) {
  if (!std::isfinite(limits.to_Hz)) limits.to_Hz = 100;
  return judge_hit(record, setup, limits, {});
}

bool has(const JudgedHit& hit, HitFaultKind kind) {
  return std::ranges::any_of(hit.faults, [&](const HitFault& fault) { return fault.kind == kind; });
}

bool is_only(const JudgedHit& hit, HitFaultKind kind) {
  return hit.faults.size() == 1 && has(hit, kind);
}

/// A second pulse of that share, so much later, in a record with this noise of the force.
FrfRecord struck_twice(double share, double later_s, double noise_N, unsigned seed = 1) {
  const test::HitSpec spec;
  FrfRecord record = hit_on(body, spec);
  const Eigen::Index n = record.excitations.rows();
  record.excitations.col(0) +=
      share * spec.peak_N * test::pulse(n, spec.rate_Hz, spec.at_s + later_s, spec.width_s) +
      noise_N * test::white_noise(n, seed);
  return record;
}

}  // namespace

TEST_CASE("a clean hit is accepted, and its pulse measured", "[analysis][frf]") {
  const JudgedHit hit = judged(hit_on(body, {.at_s = 0.125}));
  for (const HitFault& fault : hit.faults) UNSCOPED_INFO(fault.reason);
  REQUIRE(hit.accepted());
  CHECK(hit.pulse.height == Approx(100));
  CHECK(hit.pulse.peak == 128);  // 0.125 s at 1024 Hz
  // A raised cosine is above a tenth for 1 - 2·acos(0.8)/2π = 79.5 % of its 8.2 samples.
  CHECK(hit.pulse.width() == 7);
  CHECK(hit.reaches_Hz == Approx(100).margin(0.2));
}

TEST_CASE("a hammer that pulls is judged like one that pushes", "[analysis][frf]") {
  FrfRecord record = hit_on(body, {.at_s = 0.125});
  record.excitations *= -1;
  const JudgedHit hit = judged(record);
  CHECK(hit.accepted());
  CHECK(hit.pulse.height == Approx(-100));
  record.excitations.col(0) -=
      20 * test::pulse(record.excitations.rows(), record.rate_Hz, 0.15, 0.008);
  CHECK(is_only(judged(record), HitFaultKind::double_hit));
}

SCENARIO("a second pulse is found down to the share that is allowed", "[analysis][frf]") {
  GIVEN("a force almost without noise") {
    THEN("6 % is a double hit, 4 % is none, wherever it comes") {
      for (const double later_s : {-0.05, -0.012, 0.012, 0.05, 1.0, 7.0}) {
        CAPTURE(later_s);
        const JudgedHit twice = judged(struck_twice(0.06, later_s, 0.01));
        CHECK(is_only(twice, HitFaultKind::double_hit));
        CHECK(twice.pulse.second_share() == Approx(0.06).margin(0.005));
        CHECK(judged(struck_twice(0.04, later_s, 0.01)).accepted());
      }
    }
    THEN("one that rides on the first's tail is found as well") {
      CHECK(is_only(judged(struck_twice(0.5, 0.006, 0.01)), HitFaultKind::double_hit));
    }
  }
  GIVEN("a noise of 1 % of the peak") {
    THEN("what can be told from it is 8 %, and the hit says so") {
      CHECK(judged(struck_twice(0, 1, 1)).pulse.least_share_seen() == Approx(0.08).epsilon(0.05));
      CHECK(is_only(judged(struck_twice(0.12, 0.05, 1)), HitFaultKind::double_hit));
      CHECK(judged(struck_twice(0.05, 0.05, 1)).accepted());
    }
  }
}

TEST_CASE("of a thousand clean hits in noise none is rejected", "[analysis][frf][null]") {
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  int rejected = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const test::HitSpec spec{.length_s = 2,
                             .at_s = 0.05 + 0.2 * uniform(engine),
                             .width_s = 0.004 + 0.006 * uniform(engine),
                             .peak_N = 50 + 400 * uniform(engine)};
    const Eigen::Index n = 2048;
    FrfRecord record{"hit", spec.rate_Hz,
                     spec.peak_N * test::pulse(n, spec.rate_Hz, spec.at_s, spec.width_s),
                     Eigen::MatrixXd(n, 2)};
    const Eigen::ArrayXd after = (test::times_s(n, spec.rate_Hz) - spec.at_s).max(0.0);
    for (Eigen::Index r = 0; r < 2; ++r) {  // down to e^-10 at the end
      record.responses.col(r) = (-6 * after).exp() * (300 * after).sin() +
                                0.05 * test::white_noise(n, 2 * seed + unsigned(r)).array();
    }
    record.excitations.col(0) += 0.01 * spec.peak_N * test::white_noise(n, 5000 + seed);
    const JudgedHit hit = judged(record);
    for (const HitFault& fault : hit.faults) UNSCOPED_INFO(fault.reason);
    rejected += hit.accepted() ? 0 : 1;
  }
  CHECK(rejected == 0);
}

SCENARIO("a hit that says less than it seems to is rejected with its reason", "[analysis][frf]") {
  FrfRecord record = hit_on(body);
  GIVEN("an amplifier of 60 N under a force of 100 N") {
    record.excitations = record.excitations.cwiseMin(60);
    THEN("flat tops betray it, and its range does") {
      CHECK(is_only(judged(record), HitFaultKind::overload));
      FrfSetup known = setup;
      known.excitations[0].range = 60;
      CHECK(is_only(judge_hit(record, known, {}, {}), HitFaultKind::overload));
    }
  }
  GIVEN("an accelerometer that clips at half of its peak") {
    const double top = 0.5 * record.responses.col(1).maxCoeff();
    record.responses.col(1) = record.responses.col(1).cwiseMin(top).cwiseMax(-top);
    THEN("the response is named") {
      const JudgedHit hit = judged(record);
      REQUIRE(is_only(hit, HitFaultKind::response_clipped));
      CHECK(hit.faults[0].reason.find("right+X") != std::string::npos);
    }
  }
  GIVEN("a converter of 12 bits of which the hit fills a tenth, at eight times the rate") {
    record = hit_on(body, {.rate_Hz = 8192});
    const double step_N = 1000.0 / 2048;
    record.excitations = (record.excitations / step_N).array().round() * step_N;
    const double step = 10 * record.responses.cwiseAbs().maxCoeff() / 2048;
    record.responses = (record.responses / step).array().round() * step;
    THEN("the tops of its waves are not taken for clipping") { CHECK(judged(record).accepted()); }
  }
  GIVEN("a force of 100 N where 150 N are wanted") {
    THEN("it is weak") { CHECK(is_only(judged(record, {.least_peak = 150}), HitFaultKind::weak)); }
  }
  GIVEN("a force that hardly rises above its noise") {
    record.excitations.col(0) += 10 * test::white_noise(record.excitations.rows(), 1);
    THEN("it is weak") { CHECK(has(judged(record), HitFaultKind::weak)); }
  }
  GIVEN("a band up to 300 Hz") {
    // A raised cosine of width T has its first zero at 2/T = 250 Hz; 20 dB are lost at
    // sinc(fT)/(1 - (fT)²) = 0.1, that is fT = 1.6495.
    const JudgedHit hit = judged(record, {.to_Hz = 300});
    THEN("the pulse is too long for it") {
      CHECK(is_only(hit, HitFaultKind::narrow_spectrum));
      CHECK(hit.reaches_Hz == Approx(1.6495 / 0.008).epsilon(0.01));
    }
  }
  GIVEN("half a second of it, a seventh of the time that the mode of 40 Hz takes to die") {
    record.excitations.conservativeResize(512, Eigen::NoChange);
    record.responses.conservativeResize(512, Eigen::NoChange);
    THEN("it has not decayed; an exponential window helps, at the price of damping") {
      const JudgedHit cut = judged(record);
      REQUIRE(cut.faults.size() == 2);  // of either mass
      for (const HitFault& fault : cut.faults) CHECK(fault.kind == HitFaultKind::not_decayed);
      CHECK(judge_hit(record, setup, {.to_Hz = 100}, {.decay_s = 0.1}).accepted());
    }
  }
  GIVEN("a sample that the front end lost") {
    record.responses(100, 1) = std::nan("");
    THEN("nothing else is told") { CHECK(is_only(judged(record), HitFaultKind::not_finite)); }
  }
  GIVEN("no hit at all") {
    record.excitations.setZero();
    THEN("it is weak") { CHECK(is_only(judged(record), HitFaultKind::weak)); }
  }
}

SCENARIO("hits are cut out of a long record", "[analysis][frf]") {
  constexpr double rate_Hz = 1000;
  constexpr Eigen::Index n = 20000;
  FrfRecord record{"long", rate_Hz, test::white_noise(n, 1), Eigen::MatrixXd::Zero(n, 1)};
  GIVEN("hits at 2, 7 and 12 s, one that bounces at 16 s, and one at the very end") {
    for (const double at_s : {2.0, 7.0, 12.0, 16.0, 16.2, 19.9}) {
      record.excitations.col(0) += 200 * test::pulse(n, rate_Hz, at_s, 0.008);
    }
    const std::vector<FrfRecord> hits = find_hits(record, {.before_s = 0.05, .length_s = 2});
    THEN("each is a record that begins before it, and the bounce is in the fourth") {
      REQUIRE(hits.size() == 4);
      for (const FrfRecord& hit : hits) {
        CHECK(hit.excitations.rows() == 2000);
        const ForcePulse pulse = force_pulse(hit.excitations.col(0));
        CHECK(double(pulse.first) == Approx(50).margin(3));
        CHECK((pulse.second_share() > 0.9) == (&hit == &hits.back()));
      }
      CHECK(hits[1].source == "long at 6.997 s");
    }
  }
  GIVEN("noise alone") {
    THEN("there is no hit") { CHECK(find_hits(record, {}).empty()); }
  }
  GIVEN("a search that makes no sense") {
    THEN("it throws") {
      CHECK_THROWS_AS(find_hits(record, {.length_s = 0}), std::invalid_argument);
      CHECK_THROWS_AS(find_hits(record, {.least_share = 1}), std::invalid_argument);
      record.excitations(5, 0) = std::nan("");
      CHECK_THROWS_AS(find_hits(record, {}), std::invalid_argument);
    }
  }
}
