#include "analysis/signature_lines.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/analysis/reducers.hpp"

using namespace rvbench::analysis;

namespace {

constexpr double resolution = 1.0 / 121 / 6;

Signature signature(const char* component, double order, int harmonics,
                    std::vector<double> sidebands = {}) {
  Signature s;
  s.component = component;
  s.order = order;
  s.harmonics = harmonics;
  s.sidebands = std::move(sidebands);
  return s;
}

std::vector<double> orders_of(const std::vector<SignatureLine>& lines) {
  std::vector<double> orders;
  for (const SignatureLine& line : lines) orders.push_back(line.order);
  std::sort(orders.begin(), orders.end());
  return orders;
}

bool has(const std::vector<SignatureLine>& lines, double order) {
  return std::any_of(lines.begin(), lines.end(), [&](const SignatureLine& line) {
    return std::abs(line.order - order) < resolution / 2;
  });
}

const std::vector<SignatureLine>& of(const std::vector<std::vector<SignatureLine>>& lines,
                                     const Kinematics& k, const std::string& component) {
  for (std::size_t i = 0; i < k.signatures.size(); ++i) {
    if (k.signatures[i].component == component) return lines[i];
  }
  FAIL("no " << component);
  return lines[0];
}

}  // namespace

TEST_CASE("a signature asks for its harmonics and their sidebands", "[analysis][signature]") {
  Kinematics k;
  k.signatures = {signature("gear", 0.75, 2, {0.125})};
  const auto lines = signature_lines(k, resolution);
  REQUIRE(lines.size() == 1);
  CHECK(orders_of(lines[0]) == std::vector<double>{0.625, 0.75, 0.875, 1.375, 1.5, 1.625});
  for (const SignatureLine& line : lines[0]) {
    CAPTURE(line.order);
    const bool is_harmonic = line.order == 0.75 || line.order == 1.5;
    CHECK((line.sideband_of < 0) == is_harmonic);
    if (line.sideband_of < 0) continue;
    const double harmonic = lines[0][static_cast<std::size_t>(line.sideband_of)].order;
    CHECK(std::abs(line.order - harmonic) == 0.125);
  }
}

TEST_CASE("a line belongs to the part whose lower harmonic it is", "[analysis][signature]") {
  Kinematics k;
  k.signatures = {signature("slow", 0.5, 4), signature("fast", 1.5, 2)};
  const auto lines = signature_lines(k, resolution);
  CHECK(orders_of(lines[0]) == std::vector<double>{0.5, 1, 2});
  CHECK(orders_of(lines[1]) == std::vector<double>{1.5, 3});
}

TEST_CASE("no line is asked for twice: its power would count twice", "[analysis][signature]") {
  const double turns = GENERATE(4.0, 6.0, 50.0);
  const Kinematics k = rvbench::test::rv20e();
  const auto lines = signature_lines(k, 1.0 / 121 / turns);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    CAPTURE(k.signatures[i].component);
    const auto orders = orders_of(lines[i]);
    for (std::size_t a = 1; a < orders.size(); ++a) {
      CHECK(orders[a] - orders[a - 1] > 0.75 / 121 / turns);
    }
  }
}

TEST_CASE("in the RV-20E each part keeps a line of its own", "[analysis][signature]") {
  const Kinematics k = rvbench::test::rv20e();
  const auto lines = signature_lines(k, resolution);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    CAPTURE(k.signatures[i].component);
    CHECK_FALSE(lines[i].empty());
  }
  CHECK(has(of(lines, k, "input_shaft"), 1));
  CHECK(has(of(lines, k, "input_shaft"), 2));
  CHECK(has(of(lines, k, "sun_gear"), 120.0 / 121));
  CHECK(has(of(lines, k, "planet_gear"), 80.0 / 121));
  CHECK(has(of(lines, k, "pin_housing"), 156.0 / 121));
  // The planet's third harmonic is the sun's first.
  CHECK_FALSE(has(of(lines, k, "planet_gear"), 120.0 / 121));
  // The sun's +1/121 sideband is the input shaft.
  CHECK_FALSE(has(of(lines, k, "sun_gear"), 1));
}

TEST_CASE("rolling elements keep their lines wherever those fall", "[analysis][signature]") {
  Kinematics k;
  k.signatures = {signature("gear", 0.5, 8), signature("bearing_outer", 1.5, 2)};
  k.signatures[1].slip = 0.02;
  CHECK(orders_of(signature_lines(k, resolution)[1]) == std::vector<double>{1.5, 3});
}
