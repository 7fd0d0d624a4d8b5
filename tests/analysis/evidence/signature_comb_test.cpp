#include "analysis/evidence/signature_comb.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "tests/analysis/reducers.hpp"

using namespace rvbench;
using analysis::decoy_shifts;
using analysis::signature_combs;
using analysis::SignatureComb;
using test::rv20e;

namespace {

constexpr int periods = 4;
constexpr double resolution = 1.0 / (121 * periods);

}  // namespace

TEST_CASE("a comb of gears is looked for at one place, of what rolls within its slip",
          "[analysis][evidence]") {
  const analysis::Kinematics k = rv20e();
  const auto combs = signature_combs(k, resolution);
  REQUIRE(combs.size() == k.signatures.size());
  for (std::size_t s = 0; s < combs.size(); ++s) {
    const SignatureComb& comb = combs[s];
    CAPTURE(k.signatures[s].component);
    CHECK(comb.stretches[comb.nominal] == Approx(1));
    CHECK(comb.rolls == (k.signatures[s].slip > 0));
    if (!comb.rolls) {
      CHECK(comb.stretches.size() == 1);
      continue;
    }
    CHECK(comb.stretches.minCoeff() == Approx(1 - k.signatures[s].slip));
    CHECK(comb.stretches.maxCoeff() == Approx(1 + k.signatures[s].slip));
    // No line is stepped over.
    for (Eigen::Index i = 0; i < comb.bins.rows(); ++i) {
      for (Eigen::Index t = 1; t < comb.bins.cols(); ++t) {
        CHECK(comb.bins(i, t) - comb.bins(i, t - 1) <= 1);
      }
    }
  }
}

TEST_CASE(
    "decoys of the gear train's combs lie between its lines, those of what rolls beyond "
    "their own search",
    "[analysis][evidence]") {
  for (const SignatureComb& comb : signature_combs(rv20e(), resolution)) {
    const auto shifts = decoy_shifts(comb, periods);
    CHECK(shifts.size() == std::size_t{analysis::decoys});
    CHECK(std::set<Eigen::Index>(shifts.begin(), shifts.end()).size() == shifts.size());
    Eigen::Index down = 0;
    for (const Eigen::Index shift : shifts) {
      if (comb.rolls) {
        CHECK(double(std::abs(shift)) * resolution > 0.02 * comb.order);
      } else {
        CHECK(std::abs(shift) % periods == 2);
      }
      down += shift < 0 ? 1 : 0;
    }
    CHECK(down == analysis::decoys / 2);
  }
}

TEST_CASE("slip moves a harmonic and its sidebands alike: the shaft that makes them does not slip",
          "[analysis][evidence]") {
  constexpr double race_order = 11.0 / 26;
  analysis::Kinematics k;
  k.signatures = analysis::bearing_signatures({9, 7.94, 39.04, 0}, race_order, 0.02);
  const SignatureComb inner = signature_combs(k, resolution).front();
  for (const double stretch : {0.98, 1.0, 1.013}) {
    for (const analysis::SignatureLine& line : inner.lines) {
      if (line.sideband_of < 0) {
        CHECK(inner.order_of(line, stretch) == Approx(stretch * line.order));
        continue;
      }
      const analysis::SignatureLine& harmonic = inner.lines[std::size_t(line.sideband_of)];
      const double away = inner.order_of(line, stretch) - inner.order_of(harmonic, stretch);
      CHECK(std::abs(away) == Approx(race_order));
    }
  }
}

TEST_CASE("decoys are fewer where so many would lie over an order away", "[analysis][evidence]") {
  // Four periods of 21 turns: an order is 84 lines, of which one in four is between two others.
  const auto small = test::small_reducer();
  for (const SignatureComb& comb : signature_combs(small, 1.0 / 84)) {
    if (comb.rolls) continue;
    CHECK(decoy_shifts(comb, 4).size() == std::size_t{analysis::fewest_decoys});
  }
}

TEST_CASE("a spectrum without resolution has no combs", "[analysis][evidence]") {
  CHECK_THROWS_AS(signature_combs(rv20e(), 0), std::invalid_argument);
}
