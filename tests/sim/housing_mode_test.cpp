#include <algorithm>
#include <catch2/catch.hpp>
#include <complex>
#include <numbers>

#include "sim/effect_sites.hpp"
#include "tests/sim/sine_run.hpp"

using namespace rvbench;
using test::mass_on_spring;
using Complex = std::complex<double>;

namespace {

sim::PlantSpec with_unbalance(sim::PlantSpec plant) {
  plant.bodies.push_back({"rotor", sim::Motion::rotation, {1, "kg·m²"}});
  return sim::with_effect(plant, "unbalance", {.body_a = "m", .reference = "rotor"},
                          {{"amount", {1e-3, "kg·m"}}});
}

sim::PlantSpec on_frame(const sim::PlantSpec& plant, double frequency_Hz) {
  return sim::with_effect(plant, "housing_mode", {.body_a = "m"},
                          {{"frequency", {frequency_Hz, "Hz"}},
                           {"damping_ratio", {0.04, "1"}},
                           {"mass_ratio", {3, "1"}}});
}

// Way of the mass for 1 N on it; frame of 6 kg, 5 Hz and 4 %: two equations, solved by hand.
Complex way_per_N(double omega) {
  const Complex j(0, 1);
  const double frame_rad_s = 2 * std::numbers::pi * 5;
  const Complex joint = 800.0 + j * omega * 8.0;
  const Complex mass = joint - omega * omega * 2;
  const Complex frame = joint + 6.0 * (frame_rad_s * frame_rad_s - omega * omega +
                                       2.0 * j * 0.04 * frame_rad_s * omega);
  return frame / (mass * frame - joint * joint);
}

std::size_t sites_in(const std::string& plant) {
  return sim::sites_of(std::get<sim::PlantSpec>(sim::read_plant(plant)),
                       *sim::standard_terms().find("housing_mode"))
      .size();
}

}  // namespace

SCENARIO("a body on a frame that gives way moves as two masses on two springs do", "[sim][modes]") {
  const double frequency_Hz = GENERATE(1.0, 2.5, 5.0, 6.4, 20.0);
  const auto shown = test::run_of(on_frame(mass_on_spring(), 5), test::sine_of(frequency_Hz));
  const Complex way = test::settled_line(shown[0], frequency_Hz) / 3.0;
  const Complex expected = way_per_N(2 * std::numbers::pi * frequency_Hz);
  CHECK(std::abs(way - expected) < 1e-4 * std::abs(expected));
}

SCENARIO("a frame that rings far above all that happens is not there", "[sim][modes]") {
  const auto firm = test::run_of(mass_on_spring(), test::sine_of(2.5));
  const auto stiff = test::run_of(on_frame(mass_on_spring(), 5000), test::sine_of(2.5));
  const Complex line = test::settled_line(firm[0], 2.5);
  CHECK(std::abs(test::settled_line(stiff[0], 2.5) - line) < 1e-5 * std::abs(line));
}

SCENARIO("what acts on the body alone stays with the ground", "[sim][modes]") {
  const sim::PlantSpec soft = on_frame(with_unbalance(mass_on_spring()), 5);
  CHECK(soft.find_term("spring")->body_b == "frame");
  CHECK(soft.find_term("damper")->body_b == "frame");
  CHECK(soft.find_term("unbalance")->body_b == sim::housing_name);
}

SCENARIO("what a program's own term does decides whether the frame feels it", "[sim][modes]") {
  const bool between_two = GENERATE(false, true);
  sim::TermLibrary library = sim::standard_terms();
  sim::TermType own = *library.find("spring");
  own.card.name = "own";
  own.gate.between_two = between_two;
  library.add(own);
  sim::PlantSpec plant = test::plant_of(test::mass_on(""));
  plant = sim::with_effect(plant, "own", {.body_a = "m"}, {{"stiffness", {800, "N/m"}}}, library);
  const sim::TermType& mode = *library.find("housing_mode");
  REQUIRE(sim::sites_of(plant, mode, library).size() == (between_two ? 1 : 0));
  const auto soften = [&] {
    return sim::with_effect(
        plant, "housing_mode", {.body_a = "m"},
        {{"frequency", {5, "Hz"}}, {"damping_ratio", {0.04, "1"}}, {"mass_ratio", {3, "1"}}},
        library);
  };
  if (between_two) {
    CHECK(soften().find_term("own")->body_b == "frame");
  } else {
    CHECK_THROWS_AS(soften(), std::invalid_argument);
  }
}

SCENARIO("a frame is looked for under bodies that slide on the housing", "[sim][modes]") {
  const sim::TermType& type = *sim::standard_terms().find("housing_mode");
  const auto sites = sim::sites_of(mass_on_spring(), type);
  REQUIRE(sites.size() == 1);
  CHECK(sim::describe(sites[0]) == "m against the housing");
  CHECK(sites_in("emps") == 1);
  CHECK(sites_in("silverbox") == 1);
  THEN("not where all bodies turn, nor where levels of a random vibration are compared") {
    CHECK(sites_in("rv20e_bench") == 0);
    CHECK(sites_in("ur10e_joint") == 0);
    CHECK(sites_in("bearing_housing") == 0);
  }
  THEN("not under a body that nothing joins to the housing") {
    const sim::PlantSpec loose = test::plant_of(test::mass_on(""));
    CHECK(sim::sites_of(loose, type).empty());
    CHECK_THROWS_AS(on_frame(loose, 5), std::invalid_argument);
  }
  THEN("nor under one that only something of its own pushes") {
    const sim::PlantSpec shaken = with_unbalance(test::plant_of(test::mass_on("")));
    CHECK(sim::sites_of(shaken, type).empty());
    CHECK_THROWS_AS(on_frame(shaken, 5), std::invalid_argument);
  }
}
