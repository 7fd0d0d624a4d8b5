#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/diagnosis.hpp"
#include "tests/analysis/two_parts.hpp"

using namespace rvbench;
using analysis::conclude;
using analysis::Diagnosis;
using analysis::Examination;
using analysis::Kinematics;
using test::nothing;
using test::point;
using test::two_parts;

TEST_CASE("nothing measured is not resolvable, and no finding", "[analysis][conclude]") {
  const Diagnosis d = conclude({}, two_parts());
  CHECK_FALSE(d.resolvable);
  CHECK(d.findings.empty());
}

TEST_CASE("a limit of nothing at all leaves every figure finite", "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].depth_limit = k.signatures[1].depth_limit = 0;
  const Diagnosis d = conclude({point("a", {0.6, 1e-9}, {0.2, 1e-9})}, k);
  REQUIRE(d.findings.size() == 2);
  CHECK(d.findings[0].component == "shaft");
  CHECK(d.findings[0].confidence == Approx(0.75));
  CHECK(d.findings[1].confidence == Approx(0.25));
}

TEST_CASE("a part above its limit is a finding, below it a remark", "[analysis][conclude]") {
  const Diagnosis d = conclude({point("a", {0.5, 1e-12}, {0.1, 1e-12})}, two_parts());
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].component == "shaft");
  CHECK(d.findings[0].mechanism == "wear");
  CHECK(d.findings[0].severity == 0.5);
  CHECK(d.findings[0].limit == 0.2);
  CHECK(d.findings[0].frequency_Hz == Approx(20));
  CHECK(d.findings[0].confidence == 1);
  CHECK(d.findings[0].advice == "look at the shaft");
  CHECK(d.findings[0].line_orders == std::vector<double>{4, 2});  // deepest first
  REQUIRE(d.below_limit.size() == 1);
  CHECK(d.below_limit[0].component == "gear");
}

TEST_CASE(
    "a part that strikes has a lower limit where its lines are in phase, a higher one where not",
    "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].aligned_limit = 0.1;
  k.signatures[0].scatter_limit = 0.3;
  const auto limit = [&](double depth, double in_phase) {
    Examination e = point("a", {depth, 1e-12}, nothing);
    e.scores[0].in_phase = in_phase;
    const Diagnosis d = conclude({e}, k);
    CHECK(d.hypotheses().front()->component == "shaft");
    CHECK(d.findings.empty() == (depth <= d.hypotheses().front()->limit));
    return d.hypotheses().front()->limit;
  };
  CHECK(limit(0.15, 4) == 0.1);
  CHECK(limit(0.25, 0) == 0.3);
  CHECK(limit(0.25, 2) == 0.2);
  CHECK(limit(0.25, not_known) == 0.2);
  k.signatures[0].set_limit(0.4);
  CHECK(limit(0.3, 4) == 0.4);
  CHECK(limit(0.5, 0) == 0.4);
}

TEST_CASE("phases are those of the points that show the part", "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].scatter_limit = 0.3;
  std::vector<Examination> points(8, point("noise", nothing, nothing));
  for (Examination& noise : points) noise.scores[0].in_phase = -0.5;
  for (int i = 0; i < 2; ++i) {
    points.push_back(point("blow", {0.25, 1e-12}, nothing));
    points.back().scores[0].in_phase = 5;
  }
  const Diagnosis d = conclude(points, k);
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].in_phase == 5);
}

TEST_CASE("where planets cancel the mesh, the least speed tells the severity",
          "[analysis][conclude]") {
  Kinematics k = two_parts();
  std::vector<Examination> points;
  for (const auto& [speed_rpm, depth] :
       {std::pair{605, 0.9}, std::pair{1210, 0.15}, std::pair{1211, 0.17}, std::pair{1815, 0.4}}) {
    points.push_back(point(std::to_string(speed_rpm), {depth, 1e-12}, nothing));
    points.back().speed_rpm = speed_rpm;
  }
  CHECK(conclude(points, k).findings.at(0).severity == Approx(0.285));  // the median of points
  k.signatures[0].at_every_speed = true;
  const Diagnosis d = conclude(points, k);
  CHECK(d.findings.empty());
  REQUIRE(d.below_limit.size() == 1);
  CHECK(d.below_limit[0].severity == Approx(0.16));
  CHECK(d.below_limit[0].severity_high > 0.2);
}

TEST_CASE("noise is no scatter: a part that is not shown is held against its plain limit",
          "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].scatter_limit = 0.3;
  Examination e = point("a", nothing, nothing);
  e.scores[0].in_phase = 0;
  e.scores[0].smallest_visible = 0.25;
  const Diagnosis d = conclude({e}, k);
  const auto shaft = std::ranges::find(d.not_shown, "shaft", &analysis::Finding::component);
  REQUIRE(shaft != d.not_shown.end());
  CHECK(shaft->is_open());
}

TEST_CASE("noise lifts no limit over a severity that is surely above it", "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].limit_in_noise = 0.5;
  Examination e = point("a", {0.3, 1e-12}, nothing);
  e.scores[0].smallest_visible = 0.35;
  const auto is_bad = [&](double deviation) {
    e.scores[0].depth2_variance = deviation * deviation;  // of the squared depth, 0.09
    return !conclude({e}, k).findings.empty();
  };
  CHECK(is_bad(0.01));
  CHECK_FALSE(is_bad(0.05));
}

TEST_CASE(
    "a record whose noise hides a learnt limit is held against what it hides, up to the assumed",
    "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].limit_in_noise = 0.5;
  const auto limit = [&](double visible) {
    Examination e = point("a", nothing, nothing);
    e.scores[0].smallest_visible = visible;
    const Diagnosis d = conclude({e}, k);
    for (const analysis::Finding& part : d.not_shown) {
      if (part.component != "shaft") continue;
      CHECK(part.is_open() == (visible > 0.5));
      return part.limit;
    }
    return not_known;
  };
  CHECK(limit(0.1) == 0.2);
  CHECK(limit(0.3) == 0.3);
  CHECK(limit(0.7) == 0.5);
}

TEST_CASE("a deep modulation that noise may make is none", "[analysis][conclude]") {
  const Diagnosis d = conclude({point("a", {0.9, 0.01}, nothing)}, two_parts());
  CHECK(d.findings.empty());
  CHECK(d.below_limit.empty());
}

TEST_CASE("a finding pays for the number of parts looked at", "[analysis][conclude]") {
  // One point: the p-value is the point's, times two parts.
  const Diagnosis d = conclude({point("a", {0.5, 1e-6}, nothing)}, two_parts());
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].p_value == Approx(2e-6));
  CHECK(conclude({point("a", {0.5, 0.0007}, nothing)}, two_parts()).findings.empty());
}

TEST_CASE("points support each other as Fisher has it", "[analysis][conclude]") {
  const Diagnosis d =
      conclude({point("a", {0.3, 1e-5}, nothing), point("b", {0.5, 1e-4}, nothing)}, two_parts());
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].p_value == Approx(2 * 1e-9 * (1 - std::log(1e-9))));
  CHECK(d.findings[0].points == std::vector<std::string>{"a", "b"});
  CHECK(d.findings[0].severity == Approx(0.4));
}

TEST_CASE("what one record of many shows is no finding", "[analysis][conclude]") {
  std::vector<Examination> points = {point("a", {0.9, 1e-30}, nothing)};
  for (const char* source : {"b", "c", "d"}) points.push_back(point(source, nothing, nothing));
  CHECK(conclude(points, two_parts()).findings.empty());
  points[1] = point("b", {0.9, 1e-30}, nothing);
  CHECK(conclude(points, two_parts()).findings.size() == 1);
}

TEST_CASE("a part that shows at high load alone is a finding, where that is",
          "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const char* source : {"a", "b", "c", "d", "e", "f"}) {
    points.push_back(point(source, nothing, nothing));
  }
  points.push_back(point("high 1", {0.9, 1e-9}, {0.9, 5e-4}));  // of 16 looked at, the gear's
  points.push_back(point("high 2", {0.8, 1e-9}, {0.8, 5e-4}));  // are no surprise
  const Diagnosis d = conclude(points, two_parts());
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].component == "shaft");
  CHECK(d.findings[0].points == std::vector<std::string>{"high 1", "high 2"});
  CHECK(d.findings[0].severity == Approx(0.85));
}

TEST_CASE("a part is open where its limit would not be visible", "[analysis][conclude]") {
  Examination noisy = point("a", {0.0, 0.5}, {0.0, 0.5});
  for (analysis::SignatureScore& score : noisy.scores) score.depth2_variance = 1e-4;
  noisy.scores[0].smallest_visible = 0.26;  // of limits of 0.2
  noisy.scores[1].smallest_visible = 0.18;
  const Diagnosis d = conclude({noisy}, two_parts());
  REQUIRE(d.not_shown.size() == 2);
  for (const analysis::Finding& part : d.not_shown) {
    CAPTURE(part.component, part.severity_high);
    CHECK(part.is_open() == (part.component == "shaft"));
  }
}

TEST_CASE("a part whose lines no record can read is open, and its depth not known",
          "[analysis][conclude]") {
  const Diagnosis d = conclude({point("a", {0, 1}, {0.5, 1e-12})}, two_parts());
  REQUIRE(d.not_shown.size() == 1);
  CHECK(d.not_shown[0].component == "shaft");
  CHECK(std::isnan(d.not_shown[0].severity_high));
  CHECK(d.not_shown[0].p_value == 1);
  CHECK(d.not_shown[0].is_open());
}

TEST_CASE("a shaft that turns backwards has its lines at the same frequencies",
          "[analysis][conclude]") {
  Examination backwards = point("a", {0.5, 1e-12}, nothing);
  backwards.speed_rpm = -600;
  CHECK(conclude({backwards}, two_parts()).findings.at(0).frequency_Hz == Approx(20));
}

TEST_CASE("records that cannot be resolved have no say", "[analysis][conclude]") {
  Examination unresolved = point("short", {0.9, 1e-30}, {0.9, 1e-30});
  unresolved.resolvable = false;
  unresolved.quality = {{"short", "too short", true}};
  const Diagnosis alone = conclude({unresolved}, two_parts());
  CHECK_FALSE(alone.resolvable);
  CHECK(alone.findings.empty());
  CHECK(alone.quality.size() == 1);
  const Diagnosis beside = conclude({unresolved, point("a", nothing, {0.5, 1e-12})}, two_parts());
  CHECK(beside.resolvable);
  REQUIRE(beside.findings.size() == 1);
  CHECK(beside.findings[0].component == "gear");
}

TEST_CASE("the gravest finding leads, and they share the confidence", "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[1].depth_limit = 0.05;
  const Diagnosis d = conclude({point("a", {0.6, 1e-12}, {0.45, 1e-12})}, k);
  REQUIRE(d.findings.size() == 2);
  CHECK(d.findings[0].component == "gear");  // 9 times its limit, the shaft 3 times
  CHECK(d.findings[0].confidence == Approx(0.75));
  CHECK(d.findings[1].confidence == Approx(0.25));
}

TEST_CASE("a line that no part explains is listed once, at its strongest", "[analysis][conclude]") {
  Examination quiet = point("a", nothing, nothing);
  Examination loud = point("b", nothing, nothing);
  quiet.channels.resize(1);
  loud.channels.resize(1);
  quiet.channels[0].lines = {{7.7, 77, 0.1, 1e-9, ""}, {3, 30, 5, 1e-9, "shaft"}};
  loud.channels[0].lines = {{7.701, 77, 0.4, 1e-9, ""}, {5.03, 50.3, 0.2, 1e-9, ""}};
  const Diagnosis d = conclude({quiet, loud}, two_parts());
  REQUIRE(d.unexplained.size() == 2);
  CHECK(d.unexplained[0].order == Approx(7.701));
  CHECK(d.unexplained[0].amplitude == 0.4);
  CHECK(d.unexplained[1].order == 5.03);
}

TEST_CASE("every part that is not shown is weighed all the same", "[analysis][conclude]") {
  const Diagnosis d = conclude({point("a", {0.5, 1e-12}, nothing)}, two_parts());
  REQUIRE(d.not_shown.size() == 1);
  CHECK(d.not_shown[0].component == "gear");
  CHECK(d.not_shown[0].p_value == 1);  // 0.5, times two parts
  CHECK(d.not_shown[0].severity == 0);
  CHECK(std::isnan(d.not_shown[0].severity_high));  // what would be visible is not stated here
  CHECK(d.not_shown[0].points.empty());
  REQUIRE(d.second() != nullptr);
  CHECK(d.second()->component == "gear");
  CHECK(conclude({point("a", nothing, nothing)}, two_parts()).second() == nullptr);
}

TEST_CASE("likelihood ratios add over the points", "[analysis][conclude]") {
  const Diagnosis d =
      conclude({point("a", {0.3, 1e-5}, nothing), point("b", {0.5, 1e-4}, nothing)}, two_parts());
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].log_likelihood_ratio == Approx(9 * std::log(10)));
}

TEST_CASE("a part whose vibration falls with load, as its mechanism never does, comes last",
          "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const double load_pct : {25.0, 50.0, 100.0, 150.0}) {
    // The shaft is deeper, but its depth halves with every doubling of load.
    Examination e = point("p", {90 / load_pct, 1e-12}, {0.4, 1e-12});
    e.load_pct = load_pct;
    e.channels.resize(1);
    e.channels[0].rms = 1;
    points.push_back(e);
  }
  const Diagnosis d = conclude(points, two_parts());
  REQUIRE(d.findings.size() == 2);
  CHECK(d.findings[0].component == "gear");
  CHECK(d.findings[0].growth_fits);
  CHECK(d.findings[1].growth.load.exponent == Approx(-1));
  CHECK_FALSE(d.findings[1].growth_fits);
  CHECK(d.findings[1].severity > d.findings[0].severity);
  // 0.4 over 0.2 against 1.5 over 0.2, of which its growth leaves a tenth.
  CHECK(d.findings[0].confidence == Approx(2.0 / (2 + 0.75)).epsilon(0.05));
}

TEST_CASE("what one of three points shows is not known to be within its limit",
          "[analysis][conclude]") {
  const auto shaft_where_noise_hides = [](double smallest_visible) {
    std::vector<Examination> points;
    for (const char* source : {"a", "b", "c"}) points.push_back(point(source, nothing, nothing));
    points[2].scores[0] = point("c", {0.6, 1e-12}, nothing).scores[0];
    for (Examination& e : points) e.scores[0].smallest_visible = smallest_visible;
    const Diagnosis d = conclude(points, two_parts());
    REQUIRE(d.findings.empty());
    const auto shaft = std::ranges::find(d.not_shown, "shaft", &analysis::Finding::component);
    REQUIRE(shaft != d.not_shown.end());
    return *shaft;
  };
  CHECK(shaft_where_noise_hides(0.9).is_open());
  // Nor where noise hides nothing that is beyond it.
  const analysis::Finding shown_once = shaft_where_noise_hides(0.01);
  CHECK(shown_once.is_open());
  CHECK(shown_once.severity == 0);
  CHECK(shown_once.severity_high == 0.6);
}

TEST_CASE("what stands out at one speed alone, far above all that others hide, is a tone",
          "[analysis][conclude]") {
  const auto is_open = [](double depth, const std::vector<double>& speeds_rpm,
                          double shown_elsewhere = 0.01) {
    std::vector<Examination> points;
    for (const double speed_rpm : speeds_rpm) {
      points.push_back(point("a", nothing, nothing));
      points.back().speed_rpm = speed_rpm;
      points.back().scores[0].smallest_visible = 0.05;
      points.back().scores[0].depth = shown_elsewhere;
    }
    points.back().scores[0].depth = depth;
    points.back().scores[0].p_value = 1e-12;
    const Diagnosis d = conclude(points, two_parts());
    const auto shaft = std::ranges::find(d.not_shown, "shaft", &analysis::Finding::component);
    REQUIRE(shaft != d.not_shown.end());
    return shaft->is_open();
  };
  CHECK_FALSE(is_open(0.6, {605, 1210, 1815}));
  CHECK(is_open(0.4, {605, 1210, 1815}));        // damage may swing that much from speed to speed
  CHECK(is_open(0.6, {605, 1210, 1815}, 0.07));  // the others hear it as well
  CHECK(is_open(0.6, {605, 605, 1815}));         // one other speed is no majority
  CHECK(is_open(0.6, {605, 1815, 1815}));
  CHECK(is_open(0.6, {-1815, 605, 1815}));  // which way it turns makes no other speed
}

TEST_CASE("a family that no part explains is listed where most points show it",
          "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const char* source : {"a", "b", "c"}) points.push_back(point(source, nothing, nothing));
  points[0].unknown = {{.spacing = 1.775, .harmonics = 5, .severity = 0.1, .p_value = 1e-9}};
  CHECK(conclude(points, two_parts()).unknown.empty());
  points[2].unknown = {{.spacing = 1.79, .harmonics = 4, .severity = 0.3, .p_value = 1e-6}};
  const Diagnosis d = conclude(points, two_parts());
  REQUIRE(d.unknown.size() == 1);
  CHECK(d.unknown[0].spacing == 1.775);
  CHECK(d.unknown[0].severity == 0.3);
  CHECK(d.unknown[0].points == std::vector<std::string>{"a", "c"});
  CHECK(d.findings.empty());
}

TEST_CASE("an order that two speeds share is a family, though jitter leaves it few harmonics",
          "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const double speed_rpm : {605, 1210, 1815}) {
    points.push_back(point(std::to_string(speed_rpm), nothing, nothing));
    points.back().speed_rpm = speed_rpm;
  }
  points[0].unknown = {{.spacing = 1.775, .harmonics = 2, .severity = 0.2, .p_value = 1e-9}};
  points[1].unknown = {{.spacing = 1.776, .harmonics = 1, .severity = 0.2, .p_value = 1e-6}};
  CHECK(conclude(points, two_parts()).unknown.size() == 1);
  points[1].unknown[0].spacing = 1.79;  // further away than one bearing slips
  CHECK(conclude(points, two_parts()).unknown.empty());
}

TEST_CASE("what modulates at one frequency returns at no other speed", "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const char* repeat : {"a", "b", "c"}) {
    points.push_back(point(repeat, nothing, nothing));
    points.back().speed_rpm = 605;
    points.back().unknown = {{.spacing = 1.775, .harmonics = 1, .severity = 0.2, .p_value = 1e-6}};
  }
  CHECK(conclude(points, two_parts()).unknown.empty());
}

TEST_CASE("the severity counts points that show a part no deeper than their noise",
          "[analysis][conclude]") {
  std::vector<Examination> points{point("a", {0.6, 1e-9}, nothing)};
  for (const char* source : {"b", "c"}) {
    points.push_back(point(source, {0, 1e-9}, nothing));
    points.back().scores[0].depth2_variance = 1e-4;
  }
  const Diagnosis d = conclude(points, two_parts());
  CHECK(d.findings.empty());
  CHECK(d.hypotheses().front()->severity == 0);
}

TEST_CASE("noise that swings at a few points alone is no finding", "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const char* source : {"a", "b", "c"}) points.push_back(point(source, {0.5, 1e-9}, nothing));
  points[0].scores[0].by_noise = true;
  CHECK(conclude(points, two_parts()).findings.at(0).points == std::vector<std::string>{"b", "c"});
  points[1].scores[0].by_noise = true;
  CHECK(conclude(points, two_parts()).findings.at(0).points.size() == 3);
}

TEST_CASE("what would be seen is what half of the points would show", "[analysis][conclude]") {
  std::vector<Examination> points;
  for (const double visible : {0.05, 0.4, 0.06, 0.3}) {
    points.push_back(point("p", nothing, nothing));
    points.back().scores[0].smallest_visible = visible;
  }
  const Diagnosis d = conclude(points, two_parts());
  for (const analysis::Finding& part : d.not_shown) {
    if (part.component == "shaft") CHECK(part.smallest_visible == 0.06);
  }
}

TEST_CASE("severity is told in scatters of sound units, where these are known",
          "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].sound_median = 0.1;
  k.signatures[0].sound_scatter = 0.05;
  const Diagnosis d = conclude({point("a", {0.5, 1e-12}, {0.5, 1e-12})}, k);
  for (const analysis::Finding& f : d.findings) {
    if (f.component == "shaft") CHECK(f.over_sound == Approx(8));
    if (f.component == "gear") CHECK(std::isnan(f.over_sound));
  }
}

TEST_CASE("hypotheses are all parts, those that show first", "[analysis][conclude]") {
  const Diagnosis d = conclude({point("a", nothing, {0.5, 1e-12})}, two_parts());
  const auto all = d.hypotheses();
  REQUIRE(all.size() == 2);
  CHECK(all[0]->component == "gear");
  CHECK(all[1]->component == "shaft");
  CHECK(all[1]->severity == 0);
}
