#include "analysis/quality/same_samples.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/order_signals.hpp"

using namespace rvbench;
using analysis::first_of_same;

TEST_CASE("channels of one signal are told, others are not", "[analysis][quality]") {
  const Eigen::VectorXd x = test::white_noise(1000, 1);
  Eigen::VectorXd nearly = x;
  nearly[999] += 1e-9;
  const Channel a{{"a", "g", "", not_known}, 1000, 0, x};
  const Channel b{{"b", "g", "", not_known}, 1000, 0, nearly};
  const Channel c{{"c", "g", "", not_known}, 1000, 0, x};
  const Channel other_rate{{"d", "g", "", not_known}, 2000, 0, x};
  const Channel none{{"e", "g", "", not_known}, 1000, 0, {}};
  CHECK(first_of_same({&a, &b, &c, &other_rate, &c}) == std::vector<std::size_t>{0, 1, 0, 3, 0});
  CHECK(first_of_same({&none, &none}) == std::vector<std::size_t>{0, 1});
  CHECK(first_of_same({}).empty());
}
