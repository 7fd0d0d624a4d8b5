#include "analysis/evidence/visibility.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "analysis/diagnosis.hpp"
#include "analysis/evidence/decoy_p_value.hpp"

using namespace rvbench;

TEST_CASE("the least severity at which a rising sum reaches what is asked",
          "[analysis][evidence]") {
  const auto square = [](double severity) { return 100 * severity * severity; };
  CHECK(analysis::severity_reaching(4, square) == Approx(0.2).epsilon(0.01));
  CHECK(std::isinf(analysis::severity_reaching(1e12, square)));
}

TEST_CASE("a sum that is expected to be visible is significant, with room for noise",
          "[analysis][evidence]") {
  Eigen::VectorXd decoys(48);
  for (Eigen::Index i = 0; i < decoys.size(); ++i) {
    decoys[i] = 100 + 10 * std::sin(7.0 * static_cast<double>(i));
  }
  const double visible = analysis::visible_sum(decoys);
  CHECK(visible > 110);
  CHECK(analysis::decoy_p_value(visible, decoys) < analysis::significant_p);
  CHECK(analysis::decoy_p_value(visible - 1.4 * std::sqrt(visible), decoys) >
        analysis::significant_p);
  CHECK(std::isinf(analysis::visible_sum(Eigen::VectorXd::Zero(48))));
}
