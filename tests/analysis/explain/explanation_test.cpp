#include "analysis/explain/explanation.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/explain/toy_model.hpp"

namespace rvbench::analysis {

using test::ToyModel;

namespace {

constexpr double noise_N = 0.05;

// Counts standard errors of the transducer, and tells no states.
class InErrors final : public ForwardModel {
 public:
  explicit InErrors(const ToyModel::Truth& truth) : toy_(truth) {}
  const std::vector<ObservedUnit>& units() const override { return toy_.units(); }
  const std::vector<ModelParameter>& base() const override { return toy_.base(); }
  const std::vector<Candidate>& library() const override { return toy_.library(); }
  bool counts_standard_errors() const override { return true; }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>& effects,
                                           const std::vector<double>& values,
                                           const std::vector<bool>& trained) const override {
    return Eigen::VectorXd(*toy_.residuals(effects, values, trained) / noise_N);
  }

 private:
  ToyModel toy_;
};

// One value a record, each at a speed of its own, and their mean.
class MeanOfRecords final : public test::PlainModel {
 public:
  explicit MeanOfRecords(int records) {
    base_ = {{"mean", "N", 0, -10, 10, std::numeric_limits<double>::infinity(), 0.1}};
    for (int i = 0; i < records; ++i) {
      const std::string name = std::to_string(i);
      units_.push_back({name, name, name, "", i, 1});
    }
  }
  std::optional<Eigen::VectorXd> residuals(const std::vector<std::size_t>&,
                                           const std::vector<double>& values,
                                           const std::vector<bool>&) const override {
    return Eigen::VectorXd(Eigen::ArrayXd::LinSpaced(Eigen::Index(units_.size()), -1, 1).sin() -
                           values[0]);
  }
};

}  // namespace

TEST_CASE("what is named must be most of what errors do not account for", "[explain]") {
  const std::pair<std::string, std::vector<double>> drag{"drag", {0.2}};
  SECTION("all of it") {
    const Explanation e = explain(InErrors({{drag}, noise_N, 0.0}));
    CHECK(e.verdict == ExplainVerdict::named);
    CHECK(e.reason.find(" σ") != std::string::npos);
  }
  SECTION("a part of it") {
    const Explanation e = explain(InErrors({{drag, {"ripple", {1.0}}}, noise_N, 0.0}));
    CHECK(e.verdict == ExplainVerdict::none_of_the_above);
    REQUIRE_FALSE(e.effects.empty());
    CHECK(e.reason.starts_with("most of what is missing is no effect of the library; a part is"));
  }
  SECTION("nothing") {
    CHECK(explain(InErrors({{}, noise_N, 0.0})).verdict == ExplainVerdict::null);
  }
}

TEST_CASE("an effect whose law is in the library is named", "[explain]") {
  const Explanation e = explain(ToyModel({{{"drag", {0.2}}}, 0.01, 0.5}));
  REQUIRE(e.effects.size() == 1);
  CHECK(e.effects[0].verdict == ExplainVerdict::named);
  CHECK(e.effects[0].name == "drag");
}

TEST_CASE("a law that holds predicts left-out speeds and loads as well as the noise lets it",
          "[explain]") {
  const Explanation e = explain(InErrors({{{"drag", {0.2}}}, noise_N, 0.0}));
  REQUIRE(e.speeds_out.known);
  REQUIRE(e.loads_out.known);
  CHECK(e.speeds_out.after == Approx(1).epsilon(0.1));  // in units of the noise
  CHECK(e.loads_out.after == Approx(1).epsilon(0.1));
  CHECK(e.speeds_out.before > 1.5);  // what was learned at two speeds misses the third
  REQUIRE(e.speeds_out.floor);
  CHECK(e.speeds_out.after == Approx(*e.speeds_out.floor).epsilon(0.1));
}

TEST_CASE("where nothing is missing, left-out speeds and loads are off by what noise leaves there",
          "[explain]") {
  const Explanation e = explain(InErrors({{}, noise_N, 0.0}));
  REQUIRE(e.effects.empty());
  for (const LeftOutError& error : {e.speeds_out, e.loads_out}) {
    REQUIRE(error.known);
    REQUIRE(error.floor);
    CHECK(error.before == error.after);
    CHECK(error.after == Approx(*error.floor).epsilon(0.1));
  }
}

TEST_CASE("the fewer a number is learned from, the more it misses where it counts", "[explain]") {
  // A mean of n values misses a value left out by sqrt(1 + 1/n) of the scatter.
  for (const int records : {3, 9}) {
    const MeanOfRecords model(records);
    const std::vector<bool> all(model.units().size(), true);
    const Fit fit = fit_from(model, {}, {{0.0}, {1.0}}, all);
    std::vector<Fold> folds = speed_folds(model.units());
    for (Fold& fold : folds) fold.is_beyond = true;
    const auto held_out = predict_held_out(model, fit, folds, 1, LeftOut::refitted);
    REQUIRE(held_out);
    CHECK(held_out->expected_of(0, folds.size()) == Approx(std::sqrt(1 + 1.0 / (records - 1))));
  }
}

TEST_CASE("where no law's form is right, rivals that miss less than it does are its class",
          "[explain]") {
  const ToyModel model({{{"power_drag", {0.5}}}, 0.05, 0.5});
  const Explanation e = explain(model);
  REQUIRE(e.effects.size() == 2);
  CHECK(e.ceiling_after.over_model.is_clear());
  CHECK(e.selection.steps[1].equals.empty());  // by the scatter alone it would be named
  CHECK(e.effects[1].verdict == ExplainVerdict::one_of_class);
  CHECK_THAT(e.effects[1].one_of, Catch::VectorContains(std::string("drag")));
}

}  // namespace rvbench::analysis
