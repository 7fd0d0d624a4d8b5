#include "analysis/explain/selection.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "tests/analysis/explain/toy_model.hpp"

namespace rvbench::analysis {
namespace {

using test::ToyModel;

std::vector<std::string> names(const ToyModel& model, const Selection& found) {
  std::vector<std::string> all;
  for (const Step& step : found.steps) all.push_back(model.library()[step.effect].name);
  return all;
}

}  // namespace

TEST_CASE("nothing is found where nothing was left out", "[explain][null]") {
  // Noise that remembers, and records that scatter: both look like physics to a test by samples.
  int found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const ToyModel model({{}, 0.05, seed % 2 == 0 ? 0.98 : 0.5, seed % 3 == 0 ? 0.1 : 0.0, seed});
    if (!select_effects(model).steps.empty()) ++found;
  }
  CHECK(found == 0);
}

TEST_CASE("one effect left out is found by name, with its size", "[explain]") {
  const ToyModel model({{{"load_friction", {0.1}}}, 0.05, 0.9, 0.02});
  const Selection found = select_effects(model);
  REQUIRE(names(model, found) == std::vector<std::string>{"load_friction"});
  CHECK(found.fit.values.back() == Approx(0.1).epsilon(0.1));
  CHECK(found.held_out.rms < found.base_held_out.rms);
  CHECK(found.steps[0].share_won > 0.9);
  CHECK(found.miscalibrated.empty());
}

TEST_CASE("two effects are found as two", "[explain]") {
  const ToyModel model({{{"coulomb_friction", {0.3}}, {"drag", {-0.2}}}, 0.05, 0.9, 0.02});
  const auto found = names(model, select_effects(model));
  CHECK(std::set<std::string>(found.begin(), found.end()) ==
        std::set<std::string>{"coulomb_friction", "drag"});
}

TEST_CASE("effects that the data cannot part are named as equals", "[explain]") {
  // Over speeds of one sign and little range a square and a cube are alike once noise covers the
  // rest: the answer must hold both, whichever comes first.
  const ToyModel model({{{"drag", {0.08}}}, 0.15, 0.9});
  const Selection found = select_effects(model);
  REQUIRE(found.steps.size() == 1);
  std::set<std::string> set{model.library()[found.steps[0].effect].name};
  for (const std::size_t e : found.steps[0].equals) set.insert(model.library()[e].name);
  CHECK(set.contains("drag"));
}

TEST_CASE("what does little but refine an effect is none of its own", "[explain]") {
  // Between a square and a cube: neither library law is it, and beside the better one the other
  // would predict more clearly than chance.
  const ToyModel model({{{"power_drag", {0.2}}}, 0.1, 0.5});
  const Selection found = select_effects(model);
  REQUIRE(found.steps.size() == 1);
  const Step& step = found.steps[0];
  std::set<std::string> set{model.library()[step.effect].name};
  for (const std::size_t e : step.equals) set.insert(model.library()[e].name);
  CHECK(set == std::set<std::string>{"drag", "cubic_drag"});
  const auto refined = std::ranges::find_if(found.last_tried, [](const Trial& trial) {
    return trial.refused.starts_with("does little but refine");
  });
  CHECK(refined != found.last_tried.end());
}

TEST_CASE("an effect of more numbers waits for one that does most of it, and may drop it",
          "[explain]") {
  // Coulomb friction does most of what Stribeck's curve does; beside the curve it is needless.
  const ToyModel model({{{"stribeck_friction", {0.5, 1.5}}}, 0.05, 0.5});
  const Selection found = select_effects(model);
  CHECK(names(model, found) == std::vector<std::string>{"stribeck_friction"});
}

TEST_CASE("a small effect that no accepted one can do is not taken for a refinement", "[explain]") {
  const ToyModel model({{{"drag", {2}}, {"load_friction", {0.02}}}, 0.02, 0.5});
  const auto found = names(model, select_effects(model));
  CHECK(std::set<std::string>(found.begin(), found.end()) ==
        std::set<std::string>{"drag", "load_friction"});
}

TEST_CASE("a base that must leave what is known of it is called miscalibrated", "[explain]") {
  class Misjudged final : public ForwardModel {
   public:
    explicit Misjudged(const ToyModel& toy) : toy_(toy), base_(toy.base()) {
      base_[0].nominal = 0.5;
      base_[0].spread = 0.01;
      base_[0].low = 0.45;
      base_[0].high = 0.55;
    }
    const std::vector<ObservedUnit>& units() const override { return toy_.units(); }
    const std::vector<ModelParameter>& base() const override { return base_; }
    const std::vector<Candidate>& library() const override { return none_; }
    std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                             const std::vector<double>& values,
                                             const std::vector<bool>& trained) const override {
      return toy_.residuals(effects, values, trained);
    }

   private:
    const ToyModel& toy_;
    std::vector<ModelParameter> base_;
    std::vector<Candidate> none_;
  };
  const ToyModel toy({});
  const Selection found = select_effects(Misjudged(toy));
  CHECK_THAT(found.miscalibrated, Catch::Contains("machine/viscous had to go to 0.55"));
  CHECK(select_effects(toy).miscalibrated.empty());
}

TEST_CASE("the same data give the same answer on any number of cores", "[explain]") {
  const ToyModel model({{{"coulomb_friction", {0.2}}}, 0.05, 0.9, 0.02});
  const Selection first = select_effects(model), second = select_effects(model);
  CHECK(first.fit.values == second.fit.values);
  CHECK(names(model, first) == names(model, second));
}

TEST_CASE("of few conditions that were recorded again, records are left out", "[explain]") {
  const auto units_of = [](int conditions, int repeats) {
    std::vector<ObservedUnit> units;
    for (int c = 0; c < conditions; ++c) {
      for (int r = 0; r < repeats; ++r) {
        const std::string condition = std::to_string(c);
        units.push_back({condition + "/" + std::to_string(r), condition, "", "", 0, 1, ""});
      }
    }
    return units;
  };
  CHECK(condition_folds(units_of(3, 2)).size() == 6);
  CHECK(condition_folds(units_of(3, 1)).size() == 3);
  CHECK(condition_folds(units_of(5, 2)).size() == 5);
  CHECK(condition_folds(units_of(1, 4)).empty());
}

}  // namespace rvbench::analysis
