#include "analysis/evidence/equal_explanations.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/spall.hpp"

using namespace rvbench;
using analysis::equal_explanations;
using analysis::Kinematics;
using analysis::SignatureScore;

namespace {

constexpr double resolution = 0.002;

// Of the first signature, found `slip` off its nominal order.
SignatureScore found(const Kinematics& k, double slip, std::vector<double> line_depths) {
  SignatureScore score;
  score.order = k.signatures[0].order * (1 + slip);
  for (std::size_t h = 1; h <= line_depths.size(); ++h) {
    score.line_orders.push_back(double(h) * score.order);
  }
  score.line_depths = std::move(line_depths);
  return score;
}

Kinematics bearings(double other_order) {
  Kinematics k;
  k.signatures = {test::spall_of("bearing_a", 3.5, 3), test::spall_of("bearing_b", other_order, 3)};
  return k;
}

}  // namespace

TEST_CASE("two bearings of one kind on one shaft explain a spall alike", "[analysis][evidence]") {
  Kinematics k = bearings(3.5);
  CHECK(equal_explanations(found(k, 0.01, {0.5, 0.3, 0.2}), k, resolution) ==
        std::vector<std::size_t>{1});
  k.signatures[1].component = k.signatures[0].component;  // as a kinematics file calls both
  CHECK(equal_explanations(found(k, 0.01, {0.5, 0.3, 0.2}), k, resolution).size() == 1);
}

TEST_CASE("bearings whose slip may bring them together are equal only there",
          "[analysis][evidence]") {
  const Kinematics k = bearings(3.6);  // 2.9 % above
  CHECK(equal_explanations(found(k, 0.015, {0.5, 0.3}), k, resolution).size() == 1);
  CHECK(equal_explanations(found(k, 0.0, {0.5, 0.3}), k, resolution).empty());
}

TEST_CASE("a line that the other has not tells them apart", "[analysis][evidence]") {
  // The other's first three are harmonics 2, 4 and 6 of the found.
  const Kinematics k = bearings(7);
  CHECK(equal_explanations(found(k, 0, {0.5, 0.3, 0.2}), k, resolution).empty());
}

TEST_CASE("a family without its first line is no explanation", "[analysis][evidence]") {
  // Only harmonic 2 of the found is heard, and it is the other's third as well.
  const Kinematics k = bearings(3.5 * 2 / 3);
  CHECK(equal_explanations(found(k, 0, {0, 0.5}), k, resolution).empty());
}

TEST_CASE("nothing found has no explanation", "[analysis][evidence]") {
  const Kinematics k = bearings(3.5);
  CHECK(equal_explanations(found(k, 0, {0, 0, 0}), k, resolution).empty());
  SignatureScore stray = found(k, 0, {0.5});
  stray.signature = 7;
  CHECK_THROWS_AS(equal_explanations(stray, k, resolution), std::invalid_argument);
}
