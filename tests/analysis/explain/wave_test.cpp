#include "analysis/explain/wave.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/explain/estimate.hpp"
#include "tests/analysis/explain/plain_model.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

constexpr double pi = 3.14159265358979323846;

// An offset, and a wave at two frequencies' lines: nothing but straight lines in its parts.
class Waves final : public test::PlainModel {
 public:
  Waves() {
    base_ = {{.name = "offset", .unit = "N"}};
    Candidate wave;
    wave.name = "wave";
    wave.parameters = {{.name = "size, cosine part", .unit = "m"},
                       {.name = "size, sine part", .unit = "m"}};
    wave.sizes = 2;
    wave.phasor = {"size", "phase"};
    Candidate line;
    line.name = "line";
    line.parameters = {{.name = "slope", .unit = "N"}};
    library_ = {line, wave};
  }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>&,
                                           const std::vector<bool>&) const override {
    return std::nullopt;
  }
};

}  // namespace

TEST_CASE("a wave is told by size and phase, and found again from them", "[analysis][explain]") {
  const Waves model;
  const auto waves = waves_among(model, {0, 1});
  REQUIRE(waves == std::vector<std::size_t>{2});
  const std::vector<double> parts{7, -1, -3e-6, 4e-6};
  const std::vector<double> told = as_waves(parts, waves);
  CHECK(told[0] == 7);
  CHECK(told[1] == -1);
  CHECK(told[2] == Approx(5e-6));
  CHECK(told[3] == Approx(pi - std::atan(4.0 / 3)));
  const std::vector<double> again = from_waves(told, waves);
  for (std::size_t i = 0; i < parts.size(); ++i) CHECK(again[i] == Approx(parts[i]));
}

TEST_CASE("estimates name size and phase, the size never below nothing", "[analysis][explain]") {
  const Waves model;
  Fit fit;
  fit.effects = {1};
  fit.values = {7, 0, 2e-6};
  fit.covariance = Eigen::Vector3d(0.01, 4e-12, 100).asDiagonal();
  const auto all = estimates(model, fit);
  REQUIRE(all.size() == 3);
  CHECK(all[1].name == "size");
  CHECK(all[1].unit == "m");
  CHECK(all[1].value == Approx(2e-6));
  CHECK(all[1].low == 0);
  CHECK(all[1].high == Approx(2e-6 + 1.645 * 2e-6));
  CHECK(all[2].name == "phase");
  CHECK(all[2].unit == "rad");
  CHECK(all[2].value == Approx(pi / 2));
  CHECK(all[2].high - all[2].low == Approx(2 * pi));  // nothing is known of it
}

TEST_CASE("the slope of a small wave is told beside it, not across nothing", "[explain]") {
  CHECK(step_of_wave(1e-6, 1) == 1e-6);
  CHECK(step_of_wave(1e-6, 1e-7) == Approx(1e-9));
  CHECK(step_of_wave(1e-6, 0) == 1e-6);
}
