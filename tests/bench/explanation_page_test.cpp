#include "bench/report/explanation_page.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "bench/report/explanation_sections.hpp"

namespace rvbench::bench {
namespace {

using Catch::Matchers::Contains;

Twin::Comparison compared(const std::string& over, double step, double off) {
  Twin::Comparison one;
  one.record = "first <record>";
  one.channel = "force";
  one.unit = "N";
  one.over = over;
  one.step = step;
  one.first = over == "time [s]" ? 0 : step;
  one.measured = Eigen::VectorXd::LinSpaced(80, 1, 2);
  one.simulated = one.measured;
  one.simulated[60] -= off;
  return one;
}

Comparisons comparisons(const std::string& over, double step) {
  const auto before = compared(over, step, 0.5), after = compared(over, step, 0);
  return {{before}, {after}, {{before, after, Eigen::VectorXd::Constant(80, 0.1)}}};
}

analysis::Explanation friction() {
  analysis::Explanation e;
  e.verdict = analysis::ExplainVerdict::named;
  e.reason = "left out: coulomb_friction (slide)";
  e.held_out_before = 0.2;
  e.held_out_after = 0.05;
  e.ceiling_after = {true, 0.04, {}};
  e.cannot_exclude = {{"backlash", {0.4, 2.0}}};
  analysis::ExplainedEffect effect;
  effect.name = "coulomb_friction";
  effect.where = "slide & rail";
  effect.parameters = {{"level", "N", 2.5, 2.25, 2.75}};
  effect.rivals = {{"shear_thinning", {42, 2}}, {"asymmetric_friction", {-3, 1}}};
  effect.next_experiment = "reverse";
  e.effects = {effect};
  return e;
}

std::string page_of(const analysis::Explanation& e, const Comparisons& shown) {
  ExplainFacts facts;
  facts.plant = "slide";
  facts.hashes = {{"r.csv", "0123abcd"}};
  return make_explanation_page(e, facts, shown);
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

const std::string darkest = "fill=\"#520c3a\"", blank = "fill=\"#ffffff\"";

}  // namespace

TEST_CASE("the page says it in a sentence first, and then shows it", "[bench][explain]") {
  const std::string page = page_of(friction(), comparisons("time [s]", 0.01));
  CHECK_THAT(page, Contains("left out: <b>coulomb friction</b>; where: slide &amp; rail; size: "
                            "level <b>2.5 N</b> (90 %: 2.25 to 2.75); rivals: shear thinning "
                            "(worse by 42 ± 2), asymmetric friction (better by 3 ± 1); next "
                            "experiment: reverse"));
  CHECK_THAT(page, Contains("cannot exclude: backlash (better than without by 0.4 ± 2)"));
  CHECK_THAT(page, Contains("0123abcd") && Contains("No two recordings repeat each other"));
  CHECK_THAT(page, Contains("first &lt;record&gt;") && !Contains("first <record>"));
  THEN("held-out errors are bars on one scale, with the floor") {
    CHECK_THAT(page, Contains("class=\"before\" style=\"width:100.0%\"></i></span><b>20 %</b>") &&
                         Contains("class=\"after\" style=\"width:25.0%\"></i></span><b>5 %</b>") &&
                         Contains("class=\"floor\" style=\"width:20.0%\"></i></span><b>4 %</b>"));
  }
  THEN("measured, before and after are drawn over each other, within the band of repeats") {
    for (const char* style : {"measured", "before", "after", "band"}) {
      CHECK_THAT(page, Contains("<path class=\"" + std::string(style) + "\""));
    }
  }
  THEN("maps of what is left over are on one scale: where nothing is left, the second is blank") {
    CHECK(count(page, darkest) == 1);
    CHECK(count(page, blank) == 79);  // two maps of 40 blocks
  }
}

TEST_CASE("lines over order are told by their numbers, in standard errors", "[bench][explain]") {
  analysis::Explanation by_orders = friction();
  by_orders.in_standard_errors = true;
  const std::string page = page_of(by_orders, comparisons("order of the input shaft", 1.0 / 121));
  CHECK_THAT(page, Contains("80/121") && Contains("<b>0.2 σ</b>"));
  CHECK_THAT(page, Contains("class=\"bar measured\"") && Contains("class=\"whisker\""));
  CHECK(count(page, darkest) == 1);
}

TEST_CASE("the strongest lines are found among such as are not known", "[bench][explain]") {
  // So many that a sort by differences of NaN leaves the known ones wherever they are.
  Eigen::VectorXd sizes = Eigen::VectorXd::Constant(200, not_known);
  for (const Eigen::Index k : {30, 90, 91, 170}) sizes[k] = double(k);
  CHECK(report::strongest(sizes, 3) == std::vector<Eigen::Index>{90, 91, 170});
  CHECK(report::strongest(sizes, 300).size() == 200);
}

TEST_CASE("what a record does not tell is grey on the page, and hides nothing else",
          "[bench][explain]") {
  const std::string grey = "fill=\"#e4e9ed\"";
  for (const bool by_orders : {false, true}) {
    Comparisons shown = by_orders ? comparisons("order of the input shaft", 1.0 / 121)
                                  : comparisons("time [s]", 0.01);
    for (const Eigen::Index k : {4, 79}) shown.before[0].measured[k] = not_known;
    shown.after[0].simulated[4] = HUGE_VAL;
    shown.after[0].simulated[79] -= 0.2;
    shown.unseen[0].before.measured[79] = not_known;
    shown.unseen[0].after.simulated[79] = not_known;
    const std::string page = page_of(friction(), shown);
    CHECK(count(page, darkest) == 1);
    CHECK_THAT(page, Contains("grey: the record does not tell") && !Contains("nan"));
    CHECK(count(page, grey) == (by_orders ? 1 : 3));
  }
  CHECK_THAT(page_of(friction(), comparisons("time [s]", 0.01)), !Contains("grey"));
}

TEST_CASE("where nothing was compared, no empty figure is shown", "[bench][explain]") {
  analysis::Explanation nothing;
  nothing.verdict = analysis::ExplainVerdict::not_resolvable;
  nothing.reason = "too few";
  const std::string page = page_of(nothing, {});
  CHECK_THAT(page, Contains("NOT_RESOLVABLE") && Contains("too few"));
  CHECK_THAT(page, !Contains("<svg") && !Contains("class=\"bars\"") && !Contains("<li>"));
}

}  // namespace rvbench::bench
