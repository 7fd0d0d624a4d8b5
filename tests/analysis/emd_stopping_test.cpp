#include <catch2/catch.hpp>

#include "analysis/emd/ensemble_emd.hpp"
#include "analysis/emd/live_emd.hpp"
#include "analysis/emd/sift_passes.hpp"
#include "analysis/emd/stopping.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using analysis::Emd;
using analysis::emd;
using analysis::StoppingRule;

namespace {

constexpr int most = 200;

// How many sifts the fastest IMF takes.
int sifts_of(const Eigen::VectorXd& x, const StoppingRule& rule) {
  Eigen::VectorXd h = x;
  analysis::SiftPasses passes(rule, {}, most);
  REQUIRE(passes.turn_into_imf(h));
  return passes.sifts();
}

const StoppingRule& never() {
  struct Never final : analysis::Stopping {
    bool is_imf(const analysis::SiftState& /*state*/) override { return false; }
  };
  static constexpr StoppingRule rule{"never", analysis::begin_stopping<Never>};
  return rule;
}

}  // namespace

TEST_CASE("a rule that never stops gives the fixed count's IMFs to the bit", "[analysis][emd]") {
  // Two ways to sift, pass by pass and all passes in a chain: the same arithmetic.
  const Eigen::VectorXd x = test::white_noise(20000, 3);
  const Emd fixed = emd(x), ruled = emd(x, {.stopping = &never()});
  REQUIRE(fixed.imfs.cols() == ruled.imfs.cols());
  CHECK((fixed.imfs - ruled.imfs).cwiseAbs().maxCoeff() < 1e-13);
  CHECK(fixed.unreliable_ends == ruled.unreliable_ends);
}

TEST_CASE("a tone is an IMF as it is", "[analysis][emd]") {
  // Its envelopes lie symmetric; crests between samples leave them 0.1 % apart.
  const Eigen::VectorXd tone = test::tone(62, 9920, 4960, 0.3);
  CHECK(sifts_of(tone, analysis::energy_stopping()) <= 1);
  CHECK(sifts_of(tone, analysis::rilling_stopping()) <= 1);
  CHECK(sifts_of(tone, analysis::s_number_stopping()) == 4);  // it waits for four of the same
}

TEST_CASE("a tone on a slower one is sifted until the slower one is gone", "[analysis][emd]") {
  const Eigen::VectorXd fast = test::tone(200, 24800, 4960, 0.3);
  const Eigen::VectorXd x = fast + 3 * test::tone(20, 24800, 4960, 1);
  const auto* rule = GENERATE(from_range(analysis::stopping_rules()));
  CAPTURE(rule->name);
  const int sifts = sifts_of(x, *rule);
  CHECK(sifts >= 1);
  CHECK(sifts < 20);
  const Emd modes = emd(x, {.imfs = 1, .sifts = most, .stopping = rule});
  CHECK((modes.imfs.col(0) - fast).segment(6200, 12400).cwiseAbs().maxCoeff() <
        0.05);  // the widest, of Rilling's
}

TEST_CASE("each rule leaves what it promises", "[analysis][emd][law]") {
  // Asked of the IMF that comes out: one more look at it finds it to be one.
  const Eigen::VectorXd x = test::white_noise(8000, 4);
  const Emd by_energy =
      emd(x, {.imfs = 3, .sifts = most, .stopping = &analysis::energy_stopping()});
  for (const auto& imf : by_energy.imfs.colwise()) {
    const Eigen::VectorXd mean = imf - emd(imf, {.imfs = 1, .sifts = 1}).imfs.col(0);
    CHECK(10 * std::log10(imf.squaredNorm() / mean.squaredNorm()) >= 49.9);
  }
  const Emd by_counts =
      emd(x, {.imfs = 3, .sifts = most, .stopping = &analysis::s_number_stopping()});
  for (const auto& imf : by_counts.imfs.colwise()) {
    int extrema = 0, crossings = 0;
    for (Eigen::Index i = 1; i < imf.size(); ++i) {
      crossings += imf[i - 1] * imf[i] < 0 ? 1 : 0;
      if (i + 1 < imf.size()) extrema += (imf[i] - imf[i - 1]) * (imf[i + 1] - imf[i]) < 0 ? 1 : 0;
    }
    CHECK(std::abs(extrema - crossings) <= 1);
  }
}

TEST_CASE("the amplitude that a rule sees is half the distance of the envelopes",
          "[analysis][emd]") {
  // A beat about a slope: envelopes at slope ± (1 + 0.5 cos).
  struct Watch final : analysis::Stopping {
    bool is_imf(const analysis::SiftState& state) override {
      const Eigen::ArrayXd t = test::times_s(state.h.size(), 4960);
      const Eigen::ArrayXd swell = 1 + 0.5 * test::tone(2, state.h.size(), 4960).array();
      const auto inner = [&](const Eigen::ArrayXd& a) {
        return a.segment(1000, a.size() - 2000).abs().maxCoeff();
      };
      CHECK(inner(state.amplitude.array() - swell) < 0.01);
      CHECK(inner(state.mean.array() - 4 * t) < 0.01);
      return true;
    }
  };
  static constexpr StoppingRule watch{"watch", analysis::begin_stopping<Watch>};
  const Eigen::ArrayXd t = test::times_s(9920, 4960);
  const Eigen::ArrayXd swell = 1 + 0.5 * test::tone(2, 9920, 4960).array();
  const Eigen::VectorXd x = 4 * t + swell * test::tone(124, 9920, 4960).array();
  CHECK(sifts_of(x, watch) == 0);
}

TEST_CASE("sifts by a rule depend on the length of the record, a fixed count does not",
          "[analysis][emd]") {
  // Why the count is the default: IMF 1 of a part is IMF 1 of the whole, away from the cut.
  const Eigen::VectorXd x = test::white_noise(60000, 12);
  const auto differs = [&](const StoppingRule* rule, int sifts) {
    const Emd whole = emd(x, {.imfs = 1, .sifts = sifts, .stopping = rule});
    const Emd part = emd(x.head(10000), {.imfs = 1, .sifts = sifts, .stopping = rule});
    return (part.imfs - whole.imfs.topRows(10000)).topRows(9000).cwiseAbs().maxCoeff();
  };
  CHECK(differs(nullptr, 10) < 1e-13);
  CHECK(differs(&analysis::s_number_stopping(), most) > 1e-3);
}

TEST_CASE("ensembles stop by rules, live EMD refuses them", "[analysis][emd][errors]") {
  const Eigen::VectorXd x = test::white_noise(2000, 6);
  analysis::EnsembleOptions options{.emd = {.imfs = 3, .sifts = most}, .members = 4};
  options.emd.stopping = &analysis::rilling_stopping();
  const Emd modes = analysis::ceemdan(x, options);
  REQUIRE(modes.imfs.cols() == 3);
  CHECK((modes.imfs.rowwise().sum() + modes.residue - x).cwiseAbs().maxCoeff() < 1e-13);
  CHECK_THROWS_WITH(analysis::LiveEmd(options.emd), Catch::Contains("LiveEmd: the rule rilling"));
}
