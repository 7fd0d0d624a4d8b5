#include "sim/robot/hammer_test.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/sim/robot/direct_solution.hpp"

using namespace rvbench;
using sim::HitKind;
using sim::VirtualRobot;
using Complex = std::complex<double>;

namespace {

sim::RobotOptions ideal_hits() {
  sim::RobotOptions options;
  options.seed = 31;
  options.hits = 1;
  options.hit_s = 1;
  options.hit_scatter = options.hit_noise = options.bad_hit_share = 0;
  return options;
}

// Laplace transform of a record: its samples are those of a signal without anything above half
// their rate.
Complex transform_at(const Channel& channel, Complex s) {
  Complex sum = 0;
  for (Eigen::Index i = 0; i < channel.samples.size(); ++i) {
    sum += channel.samples[i] * std::exp(-s * double(i) / channel.rate_Hz);
  }
  return sum / channel.rate_Hz;
}

// Hits of one kind; the bad ones come often.
struct Seen {
  Recording hit;
  sim::HitPlan plan;
};

std::vector<Seen> hits_of(HitKind kind) {
  sim::RobotOptions options = ideal_hits();
  options.hits = 4;
  options.hit_s = 0.5;
  options.bad_hit_share = 0.8;
  const sim::HammerTest test = sim::hammer_test(VirtualRobot(options));
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < test.hits.size(); ++i) {
    if (test.truth[i].kind == kind) seen.push_back({test.hits[i], test.truth[i]});
  }
  return seen;
}

// How many times the hammer's signal rises through half of its largest value.
int blows(const Eigen::VectorXd& force_N, double share) {
  const double level_N = share * force_N.maxCoeff();
  int count = 0;
  for (Eigen::Index i = 1; i < force_N.size(); ++i) {
    count += force_N[i - 1] < level_N && force_N[i] >= level_N ? 1 : 0;
  }
  return count;
}

}  // namespace

SCENARIO("an ideal hit holds the robot's FRF, to 1e-6", "[sim][robot]") {
  const VirtualRobot robot(ideal_hits());
  const sim::HammerTest test = sim::hammer_test(robot);
  REQUIRE(test.hits.size() == 18);
  // Where a record of 1 s has died away: e^{-16}.
  for (const double frequency_Hz : {11.0, 100.0, 777.0, 1500.0}) {
    const Complex s(16, units::two_pi * frequency_Hz);
    const Eigen::MatrixXcd expected = test::direct_accelerance(robot, s);
    for (const Eigen::Index path : {0, 7, 17}) {
      const Recording& hit = test.hits[std::size_t(path)];
      const Complex force = transform_at(hit.channels[0], s);
      Eigen::VectorXcd measured(42);
      for (std::size_t i = 0; i < 42; ++i) {
        measured[Eigen::Index(i)] = transform_at(hit.channels[i + 1], s) / force;
      }
      CHECK(test::relative_difference(measured, expected.col(path)) < 1e-6);
    }
  }
}

SCENARIO("a good hit is one short push of about 200 N after 50 ms of silence", "[sim][robot]") {
  for (const Recording& hit : sim::hammer_test(VirtualRobot(ideal_hits())).hits) {
    const Eigen::VectorXd& force_N = hit.channels[0].samples;
    Eigen::Index top = 0;
    CHECK(force_N.maxCoeff(&top) > 110);  // the top may fall between two samples
    CHECK(force_N.maxCoeff() < 280);
    CHECK(double(top) / 4960 == Approx(0.0505).margin(0.001));
    CHECK(blows(force_N, 0.5) == 1);
    CHECK(force_N.tail(force_N.size() - 400).cwiseAbs().maxCoeff() < 0.2);
    for (const Channel& channel : hit.channels) {  // but for the low-pass's own ringing
      CHECK(channel.samples.head(200).cwiseAbs().maxCoeff() <
            1e-3 * channel.samples.cwiseAbs().maxCoeff());
    }
  }
}

SCENARIO("hits are named by where they were aimed, hammer first", "[sim][robot]") {
  const auto hits = sim::hammer_test(VirtualRobot(ideal_hits())).hits;
  CHECK(hits[7].channels[0].info.name == "J3 active");
  CHECK(hits[7].channels[0].info.direction == "+Y");
  CHECK(hits[7].channels[0].info.unit == "N");
  CHECK(hits[7].channels[8].info.direction == "+Y");
  CHECK(hits[7].channels[8].info.unit == "m/s²");
  CHECK(hits[7].channels.size() == 43);
  CHECK(hits[7].repeat == 1);
}

SCENARIO("bad hits are what they are called", "[sim][robot]") {
  const auto doubles = hits_of(HitKind::double_hit), overloads = hits_of(HitKind::overload),
             weak = hits_of(HitKind::weak), misdirected = hits_of(HitKind::misdirected);
  for (const auto* kind : {&doubles, &overloads, &weak, &misdirected}) REQUIRE(kind->size() > 2);
  THEN("a double hit has a second blow") {
    for (const Seen& seen : doubles) CHECK(blows(seen.hit.channels[0].samples, 0.15) == 2);
  }
  THEN("an overload stays at the end of the hammer's range while the robot does not") {
    for (const Seen& seen : overloads) {
      CHECK(seen.hit.channels[0].samples.maxCoeff() == 444);
      CHECK(seen.plan.peak_N > 444);
    }
  }
  THEN("a weak hit has less than a tenth of the force") {
    for (const Seen& seen : weak) CHECK(seen.hit.channels[0].samples.maxCoeff() < 15);
  }
  THEN("a misdirected hit pushes the point along where it was not aimed") {
    for (const Seen& seen : misdirected) {
      CHECK(std::abs(seen.plan.direction[seen.plan.path % 3]) < std::cos(0.6));
      CHECK(seen.plan.direction.norm() == Approx(1));
    }
  }
}

SCENARIO("bad hits come as often as the options say, and at most every second hit of a path",
         "[sim][robot]") {
  sim::RobotOptions options;
  int bad = 0, all = 0;
  for (options.seed = 1; options.seed <= 40; ++options.seed) {
    std::array<int, 18> of_path{};
    for (const sim::HitPlan& hit : sim::plan_hits(options)) {
      const bool is_bad = hit.kind != HitKind::good;
      of_path[std::size_t(hit.path)] += is_bad ? 1 : 0;
      bad += is_bad ? 1 : 0;
      ++all;
    }
    CHECK(*std::max_element(of_path.begin(), of_path.end()) <= 2);
  }
  CHECK(double(bad) / all == Approx(0.15).margin(0.025));  // 3600 hits; a few beyond two are good
  options.bad_hit_share = 0;
  for (const sim::HitPlan& hit : sim::plan_hits(options)) CHECK(hit.kind == HitKind::good);
}

SCENARIO("good hits scatter by about 5 %", "[sim][robot]") {
  sim::RobotOptions options = ideal_hits();
  options.hits = 12;
  options.hit_s = 0.5;
  options.hit_scatter = 0.05;
  const VirtualRobot robot(options);
  const sim::HammerTest test = sim::hammer_test(robot);
  const Complex s(25, units::two_pi * 200);
  const Eigen::MatrixXcd exact = test::direct_accelerance(robot, s);
  double squares = 0;
  for (std::size_t i = 0; i < test.hits.size(); ++i) {
    const Eigen::Index path = test.truth[i].path;  // at the driving point
    const Complex measured = transform_at(test.hits[i].channels[std::size_t(path) + 1], s) /
                             transform_at(test.hits[i].channels[0], s);
    squares += std::norm(measured / exact(path, path) - 1.0);
  }
  const double scatter = std::sqrt(squares / double(test.hits.size()));
  CHECK(scatter > 0.03);
  CHECK(scatter < 0.08);
}

SCENARIO("noise is 1 % of what a nominal hit gives, also under a weak one", "[sim][robot]") {
  sim::RobotOptions clean = ideal_hits();
  clean.hit_s = 0.5;
  clean.hits = 2;
  clean.bad_hit_share = 0.5;
  sim::RobotOptions noisy = clean;
  noisy.hit_noise = 0.01;
  const sim::HammerTest without = sim::hammer_test(VirtualRobot(clean));
  const sim::HammerTest with = sim::hammer_test(VirtualRobot(noisy));
  for (std::size_t i = 0; i < with.hits.size(); ++i) {
    if (with.truth[i].kind == HitKind::overload) continue;
    const Eigen::VectorXd& x = without.hits[i].channels[40].samples;
    const Eigen::VectorXd noise = with.hits[i].channels[40].samples - x;
    CHECK(noise.norm() ==
          Approx(0.01 * x.norm() * sim::nominal_peak_N / with.truth[i].peak_N).epsilon(0.1));
  }
}

SCENARIO("the same seed gives the same hits on any number of threads", "[sim][robot]") {
  sim::RobotOptions options;
  options.hits = 2;
  options.hit_s = 0.5;
  options.threads = 1;
  const auto alone = sim::hammer_test(VirtualRobot(options)).hits;
  options.threads = 3;
  const auto together = sim::hammer_test(VirtualRobot(options)).hits;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    for (std::size_t c = 0; c < alone[i].channels.size(); ++c) {
      REQUIRE((alone[i].channels[c].samples == together[i].channels[c].samples));
    }
  }
}
