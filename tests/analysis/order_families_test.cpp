#include <catch2/catch.hpp>
#include <random>

#include "analysis/order/line_families.hpp"
#include "analysis/order/standing_lines.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::FamilyLine;
using analysis::FamilySearch;
using analysis::line_families;

namespace {

constexpr double near = 0.002;
const FamilySearch search{.near = near, .smallest_spacing = 0.2, .largest_spacing = 12};

// Places off by as much as an estimate is, and lines of no family among them.
class LineList {
 public:
  explicit LineList(unsigned seed) : engine_(seed) {}
  LineList& add(double order, bool explained = false, double amplitude = 1) {
    std::normal_distribution<double> off(0, near / 4);
    lines.push_back({order + off(engine_), amplitude, explained});
    return *this;
  }
  LineList& strays(int count) {
    std::uniform_real_distribution<double> anywhere(0.5, 60);
    for (int i = 0; i < count; ++i) add(anywhere(engine_));
    return *this;
  }
  std::vector<FamilyLine> lines;

 private:
  std::mt19937 engine_;
};

}  // namespace

TEST_CASE("a harmonic series is found by its spacing, its fundamental missing, too",
          "[analysis][order]") {
  const auto seed = GENERATE(1U, 2U, 3U);
  LineList list(seed);
  for (int k = 2; k <= 9; ++k) list.add(k * 5.1483);
  const auto found = line_families(list.strays(20).lines, search);
  REQUIRE(found.size() == 1);
  CHECK(found[0].spacing == Approx(5.1483).margin(near));
  CHECK(std::abs(found[0].spacing - 5.1483) < 4 * found[0].spacing_error);
  REQUIRE(found[0].harmonics.size() >= 8);
  for (int k = 2; k <= 9; ++k) {
    const bool there =
        std::any_of(found[0].harmonics.begin(), found[0].harmonics.end(), [&](const auto& member) {
          return member.multiple == k && member.line == std::size_t(k - 2);
        });
    CHECK(there);
  }
}

TEST_CASE("sidebands of explained lines are a family, with their carriers", "[analysis][order]") {
  LineList list(4);
  for (const double mesh : {23.0, 46.0, 69.0}) {
    list.add(mesh, true, 5);
    for (const int k : {-1, 1}) list.add(mesh + k * 1.188);
  }
  const auto found = line_families(list.strays(20).lines, search);
  REQUIRE(found.size() == 1);
  CHECK(found[0].spacing == Approx(1.188).margin(near));
  CHECK(found[0].harmonics.empty());
  int below = 0, above = 0;
  for (const auto& member : found[0].sidebands) {
    if (member.multiple == 0) continue;
    CHECK(list.lines[member.carrier].explained);
    (member.multiple < 0 ? below : above) += 1;
  }
  CHECK(below == 3);
  CHECK(above == 3);
}

TEST_CASE("two families in one spectrum are told apart", "[analysis][order]") {
  LineList list(5);
  for (int k = 1; k <= 6; ++k) list.add(k * 5.1483);
  for (const double mesh : {23.0, 46.0, 69.0}) {
    list.add(mesh, true, 5);
    for (const int k : {-2, -1, 1, 2}) list.add(mesh + k * 1.188);
  }
  auto found = line_families(list.strays(10).lines, search);
  REQUIRE(found.size() == 2);
  std::ranges::sort(found, {}, &analysis::LineFamily::spacing);
  CHECK(found[0].spacing == Approx(1.188).margin(near));
  CHECK(found[1].spacing == Approx(5.1483).margin(near));
}

TEST_CASE("what the kinematics explains is no family", "[analysis][order][null]") {
  LineList list(6);
  for (const double mesh : {23.0, 46.0, 69.0}) {
    list.add(mesh, true, 5);
    for (const int k : {-2, -1, 1, 2}) list.add(mesh + k);
  }
  FamilySearch with_shaft = search;
  with_shaft.known_spacings = {1};
  CHECK(line_families(list.lines, with_shaft).empty());
  CHECK(line_families(list.lines, search).size() == 1);  // a shaft that nobody told of
}

TEST_CASE("lines at random have no families", "[analysis][order][null]") {
  // One list in 1000 at the most: of 60, more than 1 once in 500 choices of seeds.
  std::size_t found = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    found += line_families(LineList(seed).strays(40).lines, search).size();
  }
  CHECK(found <= 1);
  CHECK(line_families({}, search).empty());
}

TEST_CASE("what no family can be looked for in is refused", "[analysis][order]") {
  CHECK_THROWS_AS(line_families({}, {0, 1, 2, {}}), std::invalid_argument);
  CHECK_THROWS_AS(line_families({}, {1, 1, 2, {}}), std::invalid_argument);
  CHECK_THROWS_AS(line_families({}, {0.1, 2, 1, {}}), std::invalid_argument);
  CHECK_THROWS_AS(line_families({{-1, 1, false}}, search), std::invalid_argument);
}

TEST_CASE("what a strong line leaks is no line", "[analysis][order]") {
  // Half way between two lines, where a Hann window leaks most, 100 dB above the noise.
  const Eigen::VectorXd x = test::tone(100.5, 8192, 8192) + 0.01 * test::tone(140, 8192, 8192) +
                            1e-5 * test::white_noise(8192, 1);
  const auto spectrum = analysis::amplitude_spectrum(x, 8192, analysis::Window::hann);
  const auto lines =
      analysis::standing_lines(spectrum, analysis::line_floor(spectrum, 0), 4000, 1e-3 / 4000);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].place == Approx(100.5).margin(0.01));
  CHECK(lines[1].place == Approx(140).margin(0.01));
}

TEST_CASE("the leakage of a Hann window is never above what is said", "[analysis][order][law]") {
  const auto spectrum =
      analysis::amplitude_spectrum(test::tone(200.5, 1024, 1024), 1024, analysis::Window::hann);
  for (Eigen::Index k = 100; k < 400; ++k) {
    CHECK(spectrum.amplitude[k] <= analysis::hann_leakage(double(k) - 200.5) * 1.01);
  }
}
