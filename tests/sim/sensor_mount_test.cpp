#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "sim/effect_sites.hpp"
#include "tests/sim/sine_run.hpp"

using namespace rvbench;
using test::mass_on_spring;
using Complex = std::complex<double>;

namespace {

// The sensor of "v" on a mount.
sim::PlantSpec with_loose_sensor(double frequency_Hz = 8, double damping_ratio = 0.05) {
  return sim::with_effect(
      mass_on_spring(), "sensor_mount", {.channel = "v"},
      {{"frequency", {frequency_Hz, "Hz"}}, {"damping_ratio", {damping_ratio, "1"}}});
}

std::vector<std::string> places_in(const sim::PlantSpec& plant) {
  std::vector<std::string> places;
  for (const auto& site : sim::sites_of(plant, *sim::standard_terms().find("sensor_mount"))) {
    places.push_back(sim::describe(site));
  }
  return places;
}

sim::PlantSpec shipped(const std::string& name) {
  return std::get<sim::PlantSpec>(sim::read_plant(name));
}

}  // namespace

SCENARIO("a sensor on a soft mount shows what its mount lets through", "[sim][modes]") {
  const double frequency_Hz = GENERATE(1.0, 4.0, 8.0, 12.0, 30.0);
  const auto shown = test::run_of(with_loose_sensor(), test::sine_of(frequency_Hz));
  const Complex way = test::settled_line(shown[0], frequency_Hz);
  const Complex speed = Complex(0, 2 * std::numbers::pi * frequency_Hz) * way;
  const double r = frequency_Hz / 8;
  const Complex resistance(0, 2 * 0.05 * r);
  const Complex expected = (1.0 + resistance) / (1 - r * r + resistance);
  CHECK(std::abs(test::settled_line(shown[1], frequency_Hz) / speed - expected) <
        1e-4 * std::abs(expected));
}

SCENARIO("other sensors of the body do not notice", "[sim][modes]") {
  const double frequency_Hz = GENERATE(1.0, 3.2, 8.0, 30.0);
  const auto firm = test::run_of(mass_on_spring(), test::sine_of(frequency_Hz));
  const auto loose = test::run_of(with_loose_sensor(), test::sine_of(frequency_Hz));
  // A millionth of the mass, ten times amplified where the mount rings.
  const Complex way = test::settled_line(firm[0], frequency_Hz);
  CHECK(std::abs(test::settled_line(loose[0], frequency_Hz) - way) < 1.5e-5 * std::abs(way));
  CHECK(with_loose_sensor().outputs[0].of == "m");
}

SCENARIO("nor where the mount rings as the body does, damped as little as it may be",
         "[sim][modes]") {
  const auto& cards = sim::standard_terms().find("sensor_mount")->parameters;
  const double least = std::ranges::find(cards, "damping_ratio", &sim::ParameterCard::name)->min;
  const double body_Hz = std::sqrt(800.0 / 2) / (2 * std::numbers::pi);
  const sim::PlantSpec resonant = with_loose_sensor(body_Hz, least);
  // From the body's foot over its flank, and between the two that a heavy mount would make of one.
  const double frequency_Hz = GENERATE(2.5, 3.1, 3.2, 3.3, 4.0);
  const auto firm = test::run_of(mass_on_spring(), test::sine_of(frequency_Hz));
  const auto loose = test::run_of(resonant, test::sine_of(frequency_Hz));
  const Complex way = test::settled_line(firm[0], frequency_Hz);
  // 1e-6/(4·0.005·0.1): the body is damped by 8/(2·√(800·2)) = 0.1.
  CHECK(std::abs(test::settled_line(loose[0], frequency_Hz) - way) < 6e-4 * std::abs(way));
}

SCENARIO("a sensor has one mount", "[sim][modes]") {
  CHECK(places_in(with_loose_sensor()) == std::vector<std::string>{"x channel"});
  THEN("nor does one that a plant file describes get another") {
    sim::PlantSpec heavier = with_loose_sensor();
    heavier.bodies.back().name = "holder";
    heavier.bodies.back().inertia.value = 0.002;  // 2 g on 2 kg
    for (sim::TermSpec& term : heavier.terms) {
      if (term.body_a == "sensor_mount") term.body_a = "holder";
    }
    heavier.outputs[1].of = "holder";
    CHECK(places_in(heavier) == std::vector<std::string>{"x channel"});
  }
  THEN("a body of the machine is none, light or heavy as it may be") {
    sim::PlantSpec pair = with_loose_sensor();
    pair.bodies.back().inertia.value = 0.1;
    CHECK(places_in(pair) == std::vector<std::string>{"x channel", "v channel"});
  }
}

SCENARIO("a mount is looked for under sensors of what slides", "[sim][modes]") {
  CHECK(places_in(mass_on_spring()) == std::vector<std::string>{"x channel", "v channel"});
  CHECK(places_in(shipped("silverbox")) == std::vector<std::string>{"V2 channel"});
  THEN("not under transducers of forces, nor where all bodies turn") {
    CHECK(places_in(shipped("emps")).empty());
    CHECK(places_in(shipped("rv20e_bench")).empty());
    sim::PlantSpec pushed = mass_on_spring();
    pushed.outputs[1].kind = sim::OutputKind::effort;
    pushed.outputs[1].of = "spring";
    CHECK(places_in(pushed) == std::vector<std::string>{"x channel"});
    CHECK_THROWS_AS(sim::with_effect(pushed, "sensor_mount", {.channel = "v"},
                                     {{"frequency", {8, "Hz"}}, {"damping_ratio", {0.05, "1"}}}),
                    std::invalid_argument);
  }
}
