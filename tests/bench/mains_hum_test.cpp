#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "analysis/explain/explanation.hpp"
#include "bench/plant_family.hpp"
#include "bench/time_twin.hpp"
#include "sim/plant_json.hpp"
#include "tests/support/under_sanitizer.hpp"

namespace rvbench::bench {
namespace {

using Complex = std::complex<double>;
using Where = std::vector<std::string>;

constexpr double mains_rad_s = 2 * std::numbers::pi * 50;

// What the plant file does not know.
struct Hidden {
  double hum_m_s = 0;     // 50 Hz, on the channel of the speed alone
  double force_N = 0;     // 50 Hz, on the mass
  double offset_m_s = 0;  // on the channel of the speed alone
  double rate_Hz = 500;
};

sim::PlantSpec mass_on_spring() {
  auto read = sim::parse_plant(hal::ConfigReader::from_text(R"({
    "plant": "mass",
    "bodies": [{"name": "mass", "motion": "translation",
                "mass": {"value": 2.05, "unit": "kg", "tolerance_pct": 5}}],
    "terms": [{"type": "spring", "body_a": "mass", "parameters":
               {"stiffness": {"value": 790, "unit": "N/m", "tolerance_pct": "free"}}},
              {"type": "damper", "body_a": "mass", "parameters":
               {"damping": {"value": 35, "unit": "N·s/m", "tolerance_pct": "free"}}}],
    "inputs": [{"channel": "push", "unit": "N", "is": "force", "body": "mass"}],
    "outputs": [{"channel": "way", "unit": "m", "is": "position", "body": "mass"},
                {"channel": "speed", "unit": "m/s", "is": "speed", "body": "mass"}]})",
                                                            "mass.json"));
  REQUIRE(read.index() == 0);
  return std::get<0>(std::move(read));
}

// Way per force of 2 kg on 800 N/m and 40 N·s/m.
Complex way_per_N(double omega) { return 1.0 / Complex(800 - 2 * omega * omega, 40 * omega); }

// The mass is pushed at two frequencies, in closed form.
Campaign pushed(const Hidden& hidden) {
  Campaign all;
  all.name = "mass";
  std::mt19937 engine(3);
  std::normal_distribution<double> normal;
  for (int r = 0; r < 6; ++r) {
    const double forces_N[] = {20.0 + 5 * (r % 3), 15.0};
    const double omegas_rad_s[] = {9.0 + r % 3, 31.0 + 2 * (r % 3)};
    const Eigen::Index n = 3000;
    Eigen::VectorXd push = Eigen::VectorXd::Zero(n), way = push, speed = push;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t_s = static_cast<double>(i) / hidden.rate_Hz;
      for (int k = 0; k < 2; ++k) {
        const double omega = omegas_rad_s[k];
        const Complex turned = forces_N[k] * std::polar(1.0, omega * t_s);
        const Complex moved = turned * way_per_N(omega);
        push[i] += turned.real();
        way[i] += moved.real();
        speed[i] += (Complex(0, omega) * moved).real();
      }
      const Complex mains = std::polar(1.0, mains_rad_s * t_s + 1.1);
      const Complex shaken = hidden.force_N * mains * way_per_N(mains_rad_s);
      way[i] += shaken.real() + 2e-4 * normal(engine);
      speed[i] += (Complex(0, mains_rad_s) * shaken).real() + hidden.hum_m_s * mains.real() +
                  hidden.offset_m_s + 5e-3 * normal(engine);
    }
    CampaignRecord record;
    record.name = "record " + std::to_string(r + 1);
    record.condition = "push " + std::to_string(r % 3);
    record.programme = record.condition;
    record.recording.source = record.name;
    record.recording.channels = {{{"push", "N", "", not_known}, hidden.rate_Hz, 0, push},
                                 {{"way", "m", "", not_known}, hidden.rate_Hz, 0, way},
                                 {{"speed", "m/s", "", not_known}, hidden.rate_Hz, 0, speed}};
    all.records.push_back(std::move(record));
  }
  return all;
}

std::unique_ptr<Twin> twin_of(const Campaign& campaign) {
  auto made = TimeTwin::make(mass_on_spring(), campaign);
  if (const auto* refusal = std::get_if<1>(&made)) FAIL(refusal->faults.front().message);
  return std::get<0>(std::move(made));
}

analysis::Explanation explained(const Hidden& hidden) {
  return analysis::explain(*twin_of(pushed(hidden)));
}

bool names(const analysis::Explanation& found, const std::string& effect) {
  return std::ranges::any_of(found.effects, [&](const analysis::ExplainedEffect& one) {
    return one.name == effect || std::ranges::count(one.one_of, effect) > 0;
  });
}

// Frequencies of the hums that are tried in these records, in each channel.
Where tried_in(const Campaign& campaign) {
  Where tried;
  const auto twin = twin_of(campaign);
  for (const analysis::Candidate& candidate : twin->library()) {
    if (candidate.name != "mains_hum" || !candidate.not_exercised.empty()) continue;
    tried.push_back(candidate.where);
  }
  return tried;
}

std::vector<analysis::Candidate> hums_of(const sim::PlantSpec& plant) {
  const PlantFamily family(plant, {{10, 1e-3, 1}, 1e-3, 10}, sim::standard_terms());
  std::vector<analysis::Candidate> hums;
  std::ranges::copy_if(family.candidates(), std::back_inserter(hums),
                       [](const auto& candidate) { return candidate.name == "mains_hum"; });
  return hums;
}

}  // namespace

TEST_CASE("a hum is tried in each channel at each frequency of the mains",
          "[bench][explain][hum]") {
  const auto hums = hums_of(mass_on_spring());
  Where where;
  for (const analysis::Candidate& hum : hums) where.push_back(hum.where);
  CHECK(where == Where{"way channel, at 50 Hz", "way channel, at 60 Hz", "way channel, at 100 Hz",
                       "way channel, at 120 Hz", "speed channel, at 50 Hz",
                       "speed channel, at 60 Hz", "speed channel, at 100 Hz",
                       "speed channel, at 120 Hz"});
  for (const analysis::Candidate& hum : hums) {
    CHECK(hum.when_small == analysis::Candidate::WhenSmall::in_proportion);
    CHECK(hum.phasor.has_value());
    CHECK(hum.parameters.size() == 2);
  }
  THEN("as large as matters in that channel, in its unit") {
    CHECK(hums.front().parameters[0].unit == "m");
    CHECK(hums.front().parameters[0].scale == Approx(0.02 * 1e-3));
    CHECK(hums.back().parameters[0].unit == "m/s");
    CHECK(hums.back().parameters[0].scale == Approx(0.02 * 1));
  }
  THEN("a resonance of the housing has no frequency of the mains") {
    const PlantFamily family(mass_on_spring(), {{10, 1e-3, 1}, 1e-3, 10, {50, 100}},
                             sim::standard_terms());
    CHECK(std::ranges::count(family.candidates(), "housing_mode", &analysis::Candidate::name) == 1);
  }
}

TEST_CASE("a hum on one channel is named with its channel, frequency and size",
          "[bench][explain][hum]") {
  if (test::too_long_under_sanitizer()) return;
  const analysis::Explanation found = explained({.hum_m_s = 0.01});
  INFO(found.reason);
  REQUIRE(found.effects.size() == 1);
  CHECK(found.effects[0].name == "mains_hum");
  CHECK(found.effects[0].where == "speed channel, at 50 Hz");
  CHECK(found.effects[0].parameters[0].unit == "m/s");
  CHECK(found.effects[0].parameters[0].value == Approx(0.01).epsilon(0.05));
  CHECK(found.effects[0].parameters[1].value == Approx(1.1).margin(0.05));
  CHECK_FALSE(names(found, "external_force"));  // it would move the way, too
}

TEST_CASE("a force at the mains' frequency, which all channels of a body show, is no hum",
          "[bench][explain][hum]") {
  if (test::too_long_under_sanitizer()) return;
  const analysis::Explanation found = explained({.force_N = 60});
  INFO(found.reason);
  CHECK_FALSE(names(found, "mains_hum"));
  REQUIRE(found.effects.size() == 1);
  CHECK(found.effects[0].name == "external_force");
  CHECK(found.effects[0].where == "mass against the housing, at 50 Hz");
  CHECK(found.effects[0].parameters[0].value == Approx(60).epsilon(0.05));
}

TEST_CASE("hums are tried below half the sample rate", "[bench][explain][hum]") {
  CHECK(tried_in(pushed({})).size() == 8);
  CHECK(tried_in(pushed({.rate_Hz = 200})) ==
        Where{"way channel, at 50 Hz", "way channel, at 60 Hz", "speed channel, at 50 Hz",
              "speed channel, at 60 Hz"});
  CHECK(tried_in(pushed({.rate_Hz = 100})).empty());
}

TEST_CASE("a constant in records of 100 Hz is no hum of 100 Hz", "[bench][explain][hum]") {
  if (test::too_long_under_sanitizer()) return;
  const analysis::Explanation found = explained({.offset_m_s = 0.01, .rate_Hz = 100});
  INFO(found.reason);
  CHECK_FALSE(names(found, "mains_hum"));
}

TEST_CASE("where nothing hums, no hum is named", "[bench][explain][hum]") {
  if (test::too_long_under_sanitizer()) return;
  const analysis::Explanation found = explained({});
  INFO(found.reason);
  CHECK(found.verdict == analysis::ExplainVerdict::null);
}

}  // namespace rvbench::bench
