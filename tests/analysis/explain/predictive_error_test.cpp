#include "analysis/explain/predictive_error.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;
using namespace rvbench::analysis;

namespace {

// Something in proportion to a load: 4 stretches of 5 values under each of four loads, time and
// again. Each time the load is as labelled within `load_error`, one error for all four stretches.
class Proportion final : public ForwardModel {
 public:
  static constexpr double factor = 3;

  Proportion(int times, double load_error, double noise, unsigned seed) : random_(seed) {
    std::normal_distribution<double> gaussian;
    for (int i = 0; i < 4 * times; ++i) {
      const double label = i % 4;
      const std::string condition = std::to_string(units_.size() / 4);
      const double load = label * (1 + load_error * gaussian(random_));
      for (int unit = 0; unit < 4; ++unit) {
        units_.push_back({condition, condition, "", "", Eigen::Index(values_.size()), 5});
        for (int value = 0; value < 5; ++value) {
          labels_.push_back(label);
          values_.push_back(factor * load + noise * gaussian(random_));
        }
      }
    }
  }

  const std::vector<ObservedUnit>& units() const override { return units_; }
  const std::vector<ModelParameter>& base() const override { return base_; }
  const std::vector<Candidate>& library() const override { return library_; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    Eigen::VectorXd out(Eigen::Index(values_.size()));
    for (std::size_t i = 0; i < values_.size(); ++i) {
      out[Eigen::Index(i)] = values_[i] - values[0] * labels_[i];
    }
    return out;
  }

  // What is measured under another load.
  double next(double label, double load_error, double noise) {
    std::normal_distribution<double> gaussian;
    const double load = label * (1 + load_error * gaussian(random_));
    return factor * load + noise * gaussian(random_);
  }

 private:
  std::mt19937 random_;
  std::vector<ObservedUnit> units_;
  std::vector<ModelParameter> base_{{"factor", "", 1}};
  std::vector<Candidate> library_;
  std::vector<double> values_, labels_;
};

// How many of what is measured next lie in their interval, over many machines.
double share_inside(double label, int times, double load_error, double noise) {
  int inside = 0;
  constexpr unsigned machines = 400;
  for (unsigned seed = 1; seed <= machines; ++seed) {
    Proportion machine(times, load_error, noise, seed);
    const std::vector<bool> all(machine.units().size(), true);
    const Fit fit = fit_from(machine, {}, {{1.0}, {4.0}}, all);
    const double half =
        PredictiveError(machine, fit).half_width_90(Eigen::VectorXd::Constant(1, label));
    if (std::abs(machine.next(label, load_error, noise) - fit.values[0] * label) <= half) ++inside;
  }
  return double(inside) / machines;
}

}  // namespace

// One standard error of a share of 400 is 1.5 %.
TEST_CASE("nine in ten of what is measured next lie within the interval", "[explain][statistics]") {
  if (test::too_long_under_sanitizer()) return;
  SECTION("as far as the loads went, and beyond") {
    CHECK(share_inside(3, 10, 0.05, 0.1) == Approx(0.9).margin(0.05));
    CHECK(share_inside(4, 10, 0.05, 0.1) == Approx(0.9).margin(0.05));
  }
  SECTION("where there is noise alone, and few conditions") {
    CHECK(share_inside(0, 2, 0, 0.1) == Approx(0.92).margin(0.05));
    CHECK(share_inside(4, 2, 0, 0.1) == Approx(0.92).margin(0.05));
  }
  SECTION("hardly eight in ten where two conditions of eight hold most of the scatter") {
    CHECK(share_inside(4, 2, 0.05, 0.1) == Approx(0.8).margin(0.05));
  }
}

TEST_CASE("an interval asks for residuals", "[explain]") {
  const Proportion machine(2, 0, 1, 1);
  CHECK_THROWS_AS(PredictiveError(machine, Fit{}), std::invalid_argument);
}
