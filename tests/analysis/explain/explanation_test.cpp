#include "analysis/explain/explanation.hpp"

#include <catch2/catch.hpp>

#include "tests/analysis/explain/toy_model.hpp"

namespace rvbench::analysis {

using test::ToyModel;

TEST_CASE("an effect whose law is in the library is named", "[explain]") {
  const Explanation e = explain(ToyModel({{{"drag", {0.2}}}, 0.01, 0.5}));
  REQUIRE(e.effects.size() == 1);
  CHECK(e.effects[0].verdict == ExplainVerdict::named);
  CHECK(e.effects[0].name == "drag");
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
