#include <algorithm>
#include <catch2/catch.hpp>

#include "analysis/emd/emd.hpp"
#include "analysis/emd/end_rule.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Knots;

namespace {

Knots knots(const std::vector<double>& at, const std::vector<double>& value) {
  Knots made;
  made.clear(analysis::EndRule::looks_at);
  for (std::size_t j = 0; j < at.size(); ++j) made.push_back(at[j], value[j]);
  return made;
}

}  // namespace

TEST_CASE("the averaged rule goes on as the signal did in the mean", "[analysis][emd]") {
  // Minima 0, 1, 2, 3 and maxima 10, 20, 30, 40, in half periods of 5 and of 7.
  Knots found = knots({5, 10, 17, 22, 29, 34, 41, 46}, {0, 10, 1, 20, 2, 30, 3, 40});
  analysis::averaged_ends().start(7, found);
  CHECK(found.at[found.first + 1] == Approx(5 - 41. / 7));
  CHECK(found.value[found.first + 1] == Approx(25));
  CHECK(found.at[found.first] == Approx(5 - 2 * 41. / 7));
  CHECK(found.value[found.first] == Approx(1.5));
}

TEST_CASE("an end sample further out than the averaged rule foresees is an extremum itself",
          "[analysis][emd]") {
  Knots found = knots({5, 10, 15, 20}, {0, 10, 0, 10});
  analysis::averaged_ends().end(-3, 60, 4, found);
  CHECK(found.at[found.end - 2] == 60);
  CHECK(found.value[found.end - 2] == -3);
  CHECK(found.at[found.end - 1] == 65);
  CHECK(found.value[found.end - 1] == 10);
}

TEST_CASE("the slope rule repeats the last two swings", "[analysis][emd]") {
  // Rises of 3 in 4 samples, falls of 2 in 6: a saw that climbs.
  Knots found = knots({5, 9, 15, 19}, {0, 3, 1, 4});
  analysis::slope_ends().start(1, found);
  CHECK(found.at[found.first] == 5 - 6 - 4);
  CHECK(found.value[found.first] == 0 + 2 - 3);
  CHECK(found.at[found.first + 1] == 5 - 6);
  CHECK(found.value[found.first + 1] == 0 + 2);
  analysis::slope_ends().end(3, 24, 4, found);
  CHECK(found.at[found.end - 2] == 19 + 6);
  CHECK(found.value[found.end - 2] == 4 - 2);
  CHECK(found.at[found.end - 1] == 19 + 6 + 4);
  CHECK(found.value[found.end - 1] == 4 - 2 + 3);
}

TEST_CASE("an end sample further out than the slope rule foresees is an extremum itself",
          "[analysis][emd]") {
  Knots found = knots({5, 9, 15, 19}, {0, 3, 1, 4});
  analysis::slope_ends().end(-1, 40, 4, found);  // later and lower than the foreseen (25, 2)
  CHECK(found.at[found.end - 2] == 40);
  CHECK(found.value[found.end - 2] == -1);
  CHECK(found.at[found.end - 1] == 44);
  CHECK(found.value[found.end - 1] == 2);
}

TEST_CASE("every end rule lays knots that span the signal", "[analysis][emd]") {
  const auto* rule = GENERATE(from_range(analysis::end_rules()));
  CAPTURE(rule->name);
  for (unsigned seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const Eigen::VectorXd x = test::white_noise(8 + seed, seed);
    Knots found;
    found.clear(analysis::EndRule::looks_at);
    analysis::ExtremaScan().advance(analysis::sift_kernels(), x.data(), x.size(), found);
    const std::size_t count = found.size();
    if (count < analysis::least_extrema) continue;
    rule->start(x[0], found);
    rule->end(x[x.size() - 1], x.size() - 1, count, found);
    CHECK(found.at[found.first + 1] <= 0);
    CHECK(found.at[found.end - 2] >= double(x.size() - 1));
    const bool in_order = std::is_sorted(found.at.begin() + std::ptrdiff_t(found.first),
                                         found.at.begin() + std::ptrdiff_t(found.end));
    CHECK(in_order);
  }
}

TEST_CASE("with any end rule a tone is its own IMF up to its ends", "[analysis][emd][law]") {
  const auto* rule = GENERATE(from_range(analysis::end_rules()));
  CAPTURE(rule->name);
  const Eigen::VectorXd tone = test::tone(62, 24800, 4960, 0.3);
  const analysis::Emd modes = analysis::emd(tone, {.imfs = 1, .rule = {.ends = rule}});
  REQUIRE(modes.imfs.cols() == 1);
  CHECK((modes.imfs.col(0) - tone).cwiseAbs().maxCoeff() < 0.02);
}
