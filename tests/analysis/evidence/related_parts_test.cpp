#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "analysis/diagnosis.hpp"
#include "tests/analysis/two_parts.hpp"

using namespace rvbench;
using analysis::conclude;
using analysis::Diagnosis;
using analysis::Examination;
using analysis::Kinematics;
using analysis::Signature;
using test::nothing;
using test::point;
using test::two_parts;

TEST_CASE("gears on one shaft are one finding, by the name of the graver", "[analysis][conclude]") {
  Kinematics k = two_parts();
  for (Signature& s : k.signatures) {
    s.shows = analysis::Shows::as_teeth;
    s.turn = 0.4;
  }
  const Diagnosis d = conclude({point("a", {0.3, 1e-12}, {0.5, 1e-12})}, k);
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].component == "gear");
  CHECK(d.findings[0].one_of == std::vector<std::string>{"gear", "shaft"});
  CHECK(d.findings[0].confidence == 1);
  CHECK(conclude({point("a", {0.5, 1e-12}, nothing)}, k).findings.at(0).one_of.empty());
}

TEST_CASE("a shaft whose gear is worse may follow from it", "[analysis][conclude]") {
  Kinematics k = two_parts();
  for (Signature& s : k.signatures) s.turn = 2;
  k.signatures[1].shows = analysis::Shows::as_teeth;
  const Diagnosis d = conclude({point("a", {0.3, 1e-12}, {0.6, 1e-12})}, k);
  REQUIRE(d.findings.size() == 2);
  CHECK(d.findings[0].component == "gear");
  CHECK(d.findings[0].may_follow_from.empty());
  CHECK(d.findings[1].may_follow_from == "gear: wear");
  // The shaft itself follows from nothing where it is far worse than its gear.
  const Diagnosis other = conclude({point("a", {1, 1e-12}, {0.3, 1e-12})}, k);
  CHECK(other.findings.at(0).component == "shaft");
  for (const analysis::Finding& f : other.findings) CHECK(f.may_follow_from.empty());
  // A bent shaft gives no tooth lines: a bad gear comes before a shaft that is somewhat worse.
  const Diagnosis both = conclude({point("a", {0.6, 1e-12}, {0.3, 1e-12})}, k);
  CHECK(both.findings.at(0).component == "gear");
  CHECK(both.findings.at(1).may_follow_from == "gear: wear");
  // A cause is as sure as what follows from it.
  CHECK(both.findings[0].confidence == both.findings[1].confidence);
}

TEST_CASE("a ring that no record can part from the sun is a set with it, shown or not",
          "[analysis][conclude]") {
  // Three planets of a stage with i = 6 pass twice per turn of the sun.
  Kinematics k = two_parts();
  Signature& ring = k.signatures[0];
  Signature& sun = k.signatures[1];
  for (Signature& s : k.signatures) s.shows = analysis::Shows::as_teeth;
  ring.strikes = true;
  ring.turn = 3.0 / 6;
  sun.turn = 5.0 / 6;
  sun.path_order = 1.0 / 6;
  const std::vector<Examination> points{point("a", {0.5, 1e-12}, nothing)};
  const auto named = [&] { return conclude(points, k).findings.at(0).one_of; };
  CHECK(named() == std::vector<std::string>{"shaft", "gear"});
  ring.turn = 4.0 / 6;  // four planets pass one and a half times
  CHECK(named().empty());
}

TEST_CASE("beside a bearing that strikes, a gear has to be seen plainly", "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[0].shows = analysis::Shows::as_blows;
  k.signatures[1].shows = analysis::Shows::as_teeth;
  Examination e = point("a", {0.9, 1e-30}, {0.25, 1e-9});
  e.scores[1].smallest_visible = 0.06;  // a fourth of what it shows
  REQUIRE(conclude({e}, k).findings.size() == 1);
  CHECK(conclude({e}, k).findings[0].component == "shaft");
  e.scores[1].smallest_visible = 0.04;
  CHECK(conclude({e}, k).findings.size() == 2);
}

TEST_CASE("a gear may be what a far worse one in its mesh spreads", "[analysis][conclude]") {
  Kinematics k = two_parts();
  for (Signature& s : k.signatures) {
    s.shows = analysis::Shows::as_teeth;
    s.turn = s.order;
    s.depth_limit = 0.02;
  }
  k.meshes = {{"mesh", 40, {{"shaft", 2, 20}, {"gear", 2.5, 16}}}};
  const Diagnosis d = conclude({point("a", {0.9, 1e-30}, {0.05, 1e-9})}, k);
  REQUIRE(d.findings.size() == 2);
  CHECK(d.findings[1].may_follow_from == "shaft: wear");
  const Diagnosis both = conclude({point("a", {0.9, 1e-30}, {0.5, 1e-9})}, k);
  CHECK(both.findings.at(1).may_follow_from.empty());
}

TEST_CASE("what shows once per turn of the cage is held against the limit of a rolling element",
          "[analysis][conclude]") {
  Kinematics k = two_parts();
  k.signatures[1].depth_limit = 0.65;
  k.bearings = {{.name = "bearing", .ball = 0, .cage_wear = 1}};
  const Diagnosis d = conclude({point("a", nothing, {0.4, 1e-12})}, k);
  REQUIRE(d.findings.size() == 1);
  CHECK(d.findings[0].component == "shaft");
  CHECK(d.findings[0].one_of == std::vector<std::string>{"shaft", "gear"});
  CHECK(d.findings[0].limit == 0.2);
  CHECK(d.not_shown.empty());
  // An element that shows itself leaves the cage its own name and limit.
  const Diagnosis both = conclude({point("a", {0.5, 1e-12}, {0.4, 1e-12})}, k);
  REQUIRE(both.below_limit.size() == 1);
  CHECK(both.below_limit[0].component == "gear");
}
