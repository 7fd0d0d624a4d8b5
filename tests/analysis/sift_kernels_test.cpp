#include "analysis/emd/sift_kernels.hpp"

#include <catch2/catch.hpp>

#include "analysis/emd/sift_chain.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::SiftChain;

TEST_CASE("nothing is left of a longer signal sifted before", "[analysis][emd]") {
  SiftChain used(10), fresh(10);
  Eigen::VectorXd longer = test::white_noise(20000, 22);
  CHECK(used.turn_into_imf(longer, 0));
  Eigen::VectorXd rising(3);
  rising << 0, 1, 2;
  CHECK_FALSE(used.turn_into_imf(rising, 0));
  CHECK(used.extrema() == 0);
  const Eigen::VectorXd x = test::white_noise(500, 23);
  Eigen::VectorXd again = x, once = x;
  CHECK(used.turn_into_imf(again, 0));
  CHECK(fresh.turn_into_imf(once, 0));
  CHECK(again == once);
}

TEST_CASE("every processor sifts to the same bits", "[analysis][emd][law]") {
  const Eigen::VectorXd noise = test::white_noise(30000, 21);
  const Eigen::VectorXd quantised = (4 * noise).array().round();
  const Eigen::VectorXd slow = test::tone(3, 30000, 4960) + 1e-3 * noise;
  const Eigen::VectorXd x =
      GENERATE_COPY(Eigen::VectorXd(noise), Eigen::VectorXd(quantised), Eigen::VectorXd(slow));
  for (const std::size_t block : {8u, 256u}) {
    Eigen::VectorXd portable = x, best = x;
    SiftChain on_any(10, {}, analysis::portable_sift_kernels()), on_this(10);
    on_any.begin(block);
    on_this.begin(block);
    CHECK(on_any.advance(portable.data(), portable.size(), true) == x.size());
    CHECK(on_this.advance(best.data(), best.size(), true) == x.size());
    CHECK(portable == best);
    CHECK(on_any.sifted_extrema() == on_this.sifted_extrema());
  }
}
