#include <algorithm>
#include <catch2/catch.hpp>
#include <initializer_list>

#include "analysis/emd/end_rule.hpp"
#include "analysis/emd/extrema.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Knots;
using List = std::vector<double>;

namespace {

Eigen::VectorXd samples(std::initializer_list<double> values) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), x.data());
  return x;
}

struct Extrema {
  List at, value;
};

Extrema left_in(const Knots& knots) {
  const auto part = [&](const List& all) {
    return List{all.begin() + std::ptrdiff_t(knots.first), all.begin() + std::ptrdiff_t(knots.end)};
  };
  return {part(knots.at), part(knots.value)};
}

Knots knots_of(const Eigen::VectorXd& x) {
  Knots found;
  found.clear(analysis::EndRule::looks_at);
  analysis::ExtremaScan().advance(analysis::sift_kernels(), x.data(), x.size(), found);
  return found;
}

Extrema extrema_of(const Eigen::VectorXd& x) { return left_in(knots_of(x)); }

Extrema mirrored(const Eigen::VectorXd& x) {
  Knots found = knots_of(x);
  const std::size_t count = found.size();
  analysis::mirrored_ends().start(x[0], found);
  analysis::mirrored_ends().end(x[x.size() - 1], x.size() - 1, count, found);
  return left_in(found);
}

}  // namespace

TEST_CASE("extrema lie inside, the end samples are none", "[analysis][emd]") {
  const Extrema found = extrema_of(samples({2, -1, 5, 5.5, 0, 1}));
  CHECK(found.at == List{1, 3, 4});
  CHECK(found.value == List{-1, 5.5, 0});
}

TEST_CASE("a plateau is one extremum, at its middle", "[analysis][emd]") {
  SECTION("of odd length") { CHECK(extrema_of(samples({0, 3, 3, 3, 1})).at == List{2}); }
  SECTION("of even length, between two samples") {
    CHECK(extrema_of(samples({0, 3, 3, 1, 2})).at == List{1.5, 3});
  }
  SECTION("unless the signal goes on in the same direction") {
    CHECK(extrema_of(samples({0, 1, 1, 2, 2, 2, 3})).at.empty());
  }
  SECTION("or it reaches the end") {
    CHECK(extrema_of(samples({3, 3, 1, 2, 2})).at == List{2});
    CHECK(extrema_of(samples({3, 3, 3})).at.empty());
  }
}

TEST_CASE("what is too short to turn has no extrema", "[analysis][emd]") {
  for (const auto& x : {samples({}), samples({1}), samples({1, 2}), samples({1, 1})}) {
    CHECK(extrema_of(x).at.size() == 0);
  }
}

TEST_CASE("extrema are the same however the samples come, whatever the processor",
          "[analysis][emd][law]") {
  const Eigen::VectorXd noise = test::white_noise(3000, 3);
  const Eigen::VectorXd x =
      GENERATE_COPY(Eigen::VectorXd(noise), Eigen::VectorXd((3 * noise).array().round()));
  const Extrema whole = extrema_of(x);
  for (const auto* kernels : {&analysis::sift_kernels(), &analysis::portable_sift_kernels()}) {
    Knots found;
    analysis::ExtremaScan scan;
    for (Eigen::Index known = 0, step = 1; known < x.size(); step = step % 23 + 1) {
      known = std::min(known + step, x.size());
      scan.advance(*kernels, x.data(), known, found);
    }
    CHECK(left_in(found).at == whole.at);
    CHECK(left_in(found).value == whole.value);
  }
}

TEST_CASE("a coarse converter loses no extremum", "[analysis][emd]") {
  const Eigen::VectorXd x = test::tone(7, 4960, 4960, 0.3) + 0.3 * test::tone(61, 4960, 4960);
  const Eigen::VectorXd quantised = (x.array() / 0.05).round() * 0.05;
  const Extrema fine = extrema_of(x), coarse = extrema_of(quantised);
  REQUIRE(coarse.at.size() == fine.at.size());
  for (std::size_t i = 0; i < fine.at.size(); ++i) {
    CHECK(std::abs(coarse.value[i] - fine.value[i]) <= 0.025 + 1e-12);
  }
}

SCENARIO("extrema are mirrored so that the envelopes span the signal", "[analysis][emd]") {
  GIVEN("a signal whose ends lie between its outer extrema") {
    const Extrema found = mirrored(samples({0, 2, -2, 1, -1, 1.5, 0}));
    THEN("the outer extrema are the axes") {
      CHECK(found.at == List{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
      CHECK(found.value == List{1.5, -1, 1, -2, 2, -2, 1, -1, 1.5, -1, 1, -2, 2});
    }
  }
  GIVEN("a signal whose ends lie beyond its outer extrema") {
    const Extrema found = mirrored(samples({-3, 2, -2, 1, -2}));
    THEN("the end samples are extrema, too, and the axes") {
      CHECK(found.at == List{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7});
      CHECK(found.value == List{1, -2, 2, -3, 2, -2, 1, -2, 1, -2, 2});
    }
  }
  GIVEN("a signal that is slow to start") {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(40);
    x.tail(5) << 1, -1, 1, -1, 0;
    const Extrema found = mirrored(x);
    THEN("both envelopes still reach past its start") {
      REQUIRE(found.at.size() > 4);
      CHECK(found.at[1] <= 0);
    }
  }
}

TEST_CASE("mirrored extrema alternate and span any signal", "[analysis][emd][law]") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const Eigen::VectorXd x = (2 * test::white_noise(12, seed)).array().round();  // many plateaus
    if (extrema_of(x).at.size() < 3) continue;
    const Extrema found = mirrored(x);
    CHECK(found.at[1] <= 0);
    CHECK(found.at[found.at.size() - 2] >= 11);
    for (std::size_t i = 1; i < found.at.size(); ++i) CHECK(found.at[i - 1] < found.at[i]);
    for (std::size_t i = 2; i < found.at.size(); ++i) {
      const double before = found.value[i - 1] - found.value[i - 2];
      const double after = found.value[i] - found.value[i - 1];
      CHECK(before * after <= 0);
    }
  }
}
