#include "bench/candidate_probes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "sim/plant_files.hpp"
#include "sim/plant_json.hpp"

namespace rvbench::bench {
namespace {

PlantFamily emps() {
  auto read = sim::read_plant("emps");
  REQUIRE(read.index() == 0);
  return PlantFamily(std::get<0>(std::move(read)), {{10, 1e-3, 1}, 1e-3, 10, {}},
                     sim::standard_terms());
}

std::size_t index_of(const PlantFamily& family, const std::string& name) {
  const auto found = std::ranges::find(family.candidates(), name, &analysis::Candidate::name);
  REQUIRE(found != family.candidates().end());
  return std::size_t(found - family.candidates().begin());
}

// Each candidate's mark is its own, but that the second one's lies so near the first one's.
Eigen::MatrixXd marks_with(const PlantFamily& family, std::size_t first, std::size_t second,
                           double cosine) {
  const auto count = Eigen::Index(family.candidates().size());
  Eigen::MatrixXd marks = Eigen::MatrixXd::Identity(count, count);
  marks(Eigen::Index(second), Eigen::Index(second)) = std::sqrt(1 - cosine * cosine);
  marks(Eigen::Index(first), Eigen::Index(second)) = cosine;
  return marks;
}

bool is_tried(const PlantFamily& family, std::size_t candidate) {
  return family.candidates()[candidate].not_exercised.empty();
}

}  // namespace

TEST_CASE("of effects that are known to look alike, one that nearly does stands for both",
          "[bench][explain]") {
  PlantFamily family = emps();
  const std::size_t coulomb = index_of(family, "coulomb_friction");
  const std::size_t stribeck = index_of(family, "stribeck_friction");
  const auto [first, second] = std::minmax(coulomb, stribeck);
  SECTION("nearly alike") {
    group_candidates(family, marks_with(family, first, second, 0.997));
    CHECK(is_tried(family, first));
    CHECK_FALSE(is_tried(family, second));
    REQUIRE(family.candidates()[first].alike.size() == 1);
    CHECK(family.candidates()[first].alike[0].name == family.candidates()[second].name);
  }
  SECTION("less so") {
    group_candidates(family, marks_with(family, first, second, 0.99));
    CHECK(is_tried(family, second));
  }
}

TEST_CASE("effects that nobody takes for each other stand for both only if they are one law here",
          "[bench][explain]") {
  PlantFamily family = emps();
  const std::size_t coulomb = index_of(family, "coulomb_friction");
  const std::size_t force = index_of(family, "external_force");
  const auto [first, second] = std::minmax(coulomb, force);
  SECTION("nearly alike") {
    group_candidates(family, marks_with(family, first, second, 0.999));
    CHECK(is_tried(family, second));
  }
  SECTION("but for rounding") {
    group_candidates(family, marks_with(family, first, second, 1 - 1e-9));
    CHECK_FALSE(is_tried(family, second));
  }
}

TEST_CASE("what leaves no mark is not tried", "[bench][explain]") {
  PlantFamily family = emps();
  const std::size_t coulomb = index_of(family, "coulomb_friction");
  const auto count = Eigen::Index(family.candidates().size());
  Eigen::MatrixXd marks = Eigen::MatrixXd::Identity(count, count);
  marks(Eigen::Index(coulomb), Eigen::Index(coulomb)) = 0.01;
  group_candidates(family, marks);
  CHECK_FALSE(is_tried(family, coulomb));
}

}  // namespace rvbench::bench
