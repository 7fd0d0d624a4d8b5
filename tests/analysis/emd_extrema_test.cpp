#include <catch2/catch.hpp>
#include <initializer_list>

#include "analysis/emd/extrema.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Extrema;
using analysis::find_extrema;
using analysis::mirror_ends;
using List = std::vector<double>;

namespace {

Eigen::VectorXd samples(std::initializer_list<double> values) {
  Eigen::VectorXd x(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), x.data());
  return x;
}

Extrema extrema_of(const Eigen::VectorXd& x) {
  Extrema found;
  find_extrema(x, found);
  return found;
}

Extrema mirrored(const Eigen::VectorXd& x) {
  Extrema found = extrema_of(x);
  mirror_ends(x, found);
  return found;
}

List at(const Extrema& e) { return {e.at.begin(), e.at.begin() + std::ptrdiff_t(e.count)}; }
List value(const Extrema& e) {
  return {e.value.begin(), e.value.begin() + std::ptrdiff_t(e.count)};
}

}  // namespace

TEST_CASE("extrema lie inside; the end samples are none", "[analysis][emd]") {
  const Extrema found = extrema_of(samples({2, -1, 5, 5.5, 0, 1}));
  CHECK(at(found) == List{1, 3, 4});
  CHECK(value(found) == List{-1, 5.5, 0});
}

TEST_CASE("a plateau is one extremum, at its middle", "[analysis][emd]") {
  SECTION("of odd length") { CHECK(at(extrema_of(samples({0, 3, 3, 3, 1}))) == List{2}); }
  SECTION("of even length, between two samples") {
    CHECK(at(extrema_of(samples({0, 3, 3, 1, 2}))) == List{1.5, 3});
  }
  SECTION("unless the signal goes on in the same direction") {
    CHECK(at(extrema_of(samples({0, 1, 1, 2, 2, 2, 3}))).empty());
  }
  SECTION("or it reaches the end") {
    CHECK(at(extrema_of(samples({3, 3, 1, 2, 2}))) == List{2});
    CHECK(at(extrema_of(samples({3, 3, 3}))).empty());
  }
}

TEST_CASE("what is too short to turn has no extrema", "[analysis][emd]") {
  for (const auto& x : {samples({}), samples({1}), samples({1, 2}), samples({1, 1})}) {
    CHECK(extrema_of(x).count == 0);
  }
  SECTION("and nothing is left of a longer signal looked at before") {
    Extrema found = extrema_of(samples({0, 1, 0, 1, 0}));
    REQUIRE(found.count == 3);
    find_extrema(samples({0, 1, 2}), found);
    CHECK(found.count == 0);
  }
}

TEST_CASE("a coarse converter loses no extremum", "[analysis][emd]") {
  const Eigen::VectorXd x = test::tone(7, 4960, 4960, 0.3) + 0.3 * test::tone(61, 4960, 4960);
  const Eigen::VectorXd quantised = (x.array() / 0.05).round() * 0.05;
  const Extrema fine = extrema_of(x), coarse = extrema_of(quantised);
  REQUIRE(coarse.count == fine.count);
  for (std::size_t i = 0; i < fine.count; ++i) {
    CHECK(std::abs(coarse.value[i] - fine.value[i]) <= 0.025 + 1e-12);
  }
}

SCENARIO("extrema are mirrored so that the envelopes span the signal", "[analysis][emd]") {
  GIVEN("a signal whose ends lie between its outer extrema") {
    const Extrema found = mirrored(samples({0, 2, -2, 1, -1, 1.5, 0}));
    THEN("the outer extrema are the axes") {
      CHECK(at(found) == List{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
      CHECK(value(found) == List{1.5, -1, 1, -2, 2, -2, 1, -1, 1.5, -1, 1, -2, 2});
    }
  }
  GIVEN("a signal whose ends lie beyond its outer extrema") {
    const Extrema found = mirrored(samples({-3, 2, -2, 1, -2}));
    THEN("the end samples are extrema, too, and the axes") {
      CHECK(at(found) == List{-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7});
      CHECK(value(found) == List{1, -2, 2, -3, 2, -2, 1, -2, 1, -2, 2});
    }
  }
  GIVEN("a signal that is slow to start") {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(40);
    x.tail(5) << 1, -1, 1, -1, 0;
    const Extrema found = mirrored(x);
    THEN("both envelopes still reach past its start") {
      REQUIRE(found.count > 4);
      CHECK(found.at[1] <= 0);
    }
  }
}

TEST_CASE("mirrored extrema alternate and span any signal", "[analysis][emd][law]") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const Eigen::VectorXd x = (2 * test::white_noise(12, seed)).array().round();  // many plateaus
    if (extrema_of(x).count < 3) continue;
    const Extrema found = mirrored(x);
    CHECK(found.at[1] <= 0);
    CHECK(found.at[found.count - 2] >= 11);
    for (std::size_t i = 1; i < found.count; ++i) CHECK(found.at[i - 1] < found.at[i]);
    for (std::size_t i = 2; i < found.count; ++i) {
      const double before = found.value[i - 1] - found.value[i - 2];
      const double after = found.value[i] - found.value[i - 1];
      CHECK(before * after <= 0);
    }
  }
}
