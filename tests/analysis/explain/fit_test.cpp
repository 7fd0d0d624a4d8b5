#include "analysis/explain/fit.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/explain/screen.hpp"
#include "tests/analysis/explain/toy_model.hpp"

namespace rvbench::analysis {
namespace {

using test::ToyModel;

std::vector<bool> all(const ForwardModel& model) {
  return std::vector<bool>(model.units().size(), true);
}

Fit base_fit(const ToyModel& model) {
  return fit_from(model, {}, {{1.0, 0.0}, {2.0, 1.0}}, all(model));
}

std::vector<Screened> screen_base(const ToyModel& model) {
  Marks marks;
  return screen(model, base_fit(model), all(model), marks);
}

// A spring of 100 MN/m and a deviation of 60 µm, each with its own mark on four records.
class SpringAndDeviation final : public test::PlainModel {
 public:
  SpringAndDeviation() {
    base_ = {{"stiffness", "N/m", 1e8, 0, 1e9, infinite, 5e6},
             {"deviation", "m", 0, -1e-3, 1e-3, infinite, 3e-6}};
    for (int record = 0; record < 4; ++record) {
      const std::string name = std::to_string(record);
      units_.push_back({name, name, "", "", record * 50, 50});
    }
  }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(200, 0, 20);
    const Eigen::ArrayXd noise = (370 * t).sin();
    return Eigen::VectorXd(noise + (1e8 - values[0]) / 1e6 * t.sin() +
                           (6e-5 - values[1]) / 1e-6 * t.cos());
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
};

}  // namespace

TEST_CASE("micrometres are found beside meganewtons per metre", "[explain]") {
  const SpringAndDeviation model;
  const Fit fit = fit_from(model, {}, {{1e8, 0}, {1e8, 3e-6}}, all(model));
  CHECK(fit.values[0] == Approx(1e8).epsilon(0.01));
  CHECK(fit.values[1] == Approx(6e-5).epsilon(0.01));
  CHECK(fit.not_certified.empty());
}

TEST_CASE("a fit finds the values that made the data, and is certified", "[explain]") {
  const ToyModel model({{{"stribeck_friction", {0.7, 0.4}}}, 0.02, 0.5});
  const Fit fit = fit_with(model, base_fit(model), model.index_of("stribeck_friction"), all(model));
  CHECK(fit.not_certified.empty());
  CHECK(fit.values[0] == Approx(1.1).epsilon(0.01));
  CHECK(fit.values[1] == Approx(0.2).epsilon(0.01));
  CHECK(fit.values[2] == Approx(0.7).epsilon(0.02));
  CHECK(fit.values[3] == Approx(0.4).epsilon(0.02));
}

TEST_CASE("standard errors are those of records, not of samples", "[explain][statistics]") {
  // An offset of each record's own scatters the fitted offset by scatter/√27, however many samples
  // a record has. Over many machines the error must be as large as the scatter of the result.
  double sum = 0, claimed = 0;
  const int machines = 60;
  for (int i = 0; i < machines; ++i) {
    const ToyModel model({{}, 0.05, 0.9, 0.3, unsigned(100 + i)});
    const Fit fit = base_fit(model);
    sum += std::pow(fit.values[1] - 0.2, 2);
    claimed += fit.covariance(1, 1);
  }
  CHECK(std::sqrt(sum / machines) == Approx(0.3 / std::sqrt(27)).epsilon(0.2));
  CHECK(std::sqrt(claimed / machines) == Approx(std::sqrt(sum / machines)).epsilon(0.2));
}

TEST_CASE("a fit whose starts end in different places is not certified", "[explain]") {
  // Far beyond all speeds measured Stribeck's curve is Coulomb friction: its speed is anything.
  const ToyModel model({{{"coulomb_friction", {0.5}}}, 1e-6, 0.0});
  const Fit base = base_fit(model);
  const std::size_t effect = model.index_of("stribeck_friction");
  const Fit fit = fit_from(model, {effect}, {{1.1, 0.2, 0, 0.1}, {1.1, 0.2, 0, 1.5}}, all(model));
  CHECK(fit.cost <= base.cost);
  // Either both starts agree, or the fit says that they do not.
  if (fit.not_certified.empty()) CHECK(fit.cost < 0.5 * base.cost);
}

TEST_CASE("only the units learned from move a fit", "[explain]") {
  ToyModel model({{{"drag", {0.3}}}, 0.01, 0.5});
  std::vector<bool> trained = all(model);
  for (std::size_t u = 0; u < trained.size(); ++u) trained[u] = model.units()[u].speed[0] == '0';
  const Fit slow = fit_from(model, {}, {{1.0, 0.0}, {2.0, 1.0}}, trained);
  const Fit whole = base_fit(model);
  CHECK(slow.values[0] == Approx(1.1 + 0.3 * 0.5 * 8 / (3 * M_PI)).epsilon(0.02));
  CHECK(whole.values[0] > 1.2 * slow.values[0]);
}

TEST_CASE("screening puts the effect that was left out first", "[explain]") {
  for (const auto& [name, values] : std::vector<std::pair<std::string, std::vector<double>>>{
           {"coulomb_friction", {0.05}},
           {"load_friction", {0.05}},
           {"stribeck_friction", {0.1, 0.2}}}) {
    CAPTURE(name);
    const ToyModel model({{{name, values}}, 0.02, 0.5});
    const auto screened = screen_base(model);
    REQUIRE_FALSE(screened.empty());
    CHECK(model.library()[screened.front().effect].name == name);
    CHECK(screened.front().p_value < 0.01 / 5);  // of five candidates
  }
}

TEST_CASE("screening says how large an effect would be, and whether it may be that", "[explain]") {
  ToyModel model({{{"coulomb_friction", {-0.3}}}, 0.01, 0.5});
  const std::size_t coulomb = model.index_of("coulomb_friction");
  const auto of_coulomb = [&] {
    const auto all_screened = screen_base(model);
    return *std::ranges::find(all_screened, coulomb, &Screened::effect);
  };
  CHECK(of_coulomb().is_admissible);
  REQUIRE(of_coulomb().start.size() == 1);
  CHECK(of_coulomb().start[0] == Approx(-0.3).epsilon(0.02));
  model.bound("coulomb_friction", 0, 10);
  CHECK_FALSE(of_coulomb().is_admissible);
}

TEST_CASE("what may not be when small is tried from far starts, if it has such", "[explain]") {
  ToyModel model({{{"stribeck_friction", {-0.3, 0.2}}}, 0.01, 0.5});
  model.bound("stribeck_friction", 0, 10);
  const std::size_t stribeck = model.index_of("stribeck_friction");
  const auto of_stribeck = [&] {
    const auto all_screened = screen_base(model);
    return *std::ranges::find(all_screened, stribeck, &Screened::effect);
  };
  CHECK_FALSE(of_stribeck().is_admissible);
  model.start_far("stribeck_friction");
  CHECK(of_stribeck().is_admissible);
  CHECK(of_stribeck().start.empty());
}

TEST_CASE("a pair may be what neither of the two may be alone", "[explain]") {
  // Drag makes up for friction: alone, what is missing looks like friction that pushes.
  ToyModel model({{{"coulomb_friction", {0.1}}, {"cubic_drag", {-0.2}}}, 0.01, 0.5});
  model.bound("coulomb_friction", 0, 10);
  const auto screened = screen_base(model);
  const auto of = [&](const std::string& name) {
    return *std::ranges::find(screened, model.index_of(name), &Screened::effect);
  };
  CHECK(pair_is_admissible(model, of("coulomb_friction"), of("cubic_drag")));
  model.bound("coulomb_friction", -10, 0);
  CHECK_FALSE(pair_is_admissible(model, of("coulomb_friction"), of("cubic_drag")));
}

TEST_CASE("what an effect does is told from what others could do as well", "[explain]") {
  const ToyModel model({{{"drag", {0.3}}, {"load_friction", {0.1}}}, 0.01, 0.5});
  const std::size_t drag = model.index_of("drag");
  const auto beside_drag = [&](const std::string& other) {
    const std::size_t effect = model.index_of(other);
    return done_by_others(
        model, fit_from(model, {drag, effect}, {{1, 0, 0.3, 0.1}, {1, 0, 0.2, 0.2}}, all(model)));
  };
  CHECK(beside_drag("cubic_drag")[0] > 0.8);
  CHECK(beside_drag("load_friction")[0] < 0.3);
}

TEST_CASE("screening leaves out what the data cannot show", "[explain]") {
  ToyModel model({{{"load_friction", {0.3}}}});
  model.hide("load_friction", "the load never changes");
  for (const Screened& s : screen_base(model)) {
    CHECK(model.library()[s.effect].name != "load_friction");
  }
}

}  // namespace rvbench::analysis
