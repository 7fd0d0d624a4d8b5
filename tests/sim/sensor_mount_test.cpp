#include <catch2/catch.hpp>
#include <complex>
#include <numbers>

#include "sim/effect_sites.hpp"
#include "tests/sim/sine_run.hpp"

using namespace rvbench;
using Complex = std::complex<double>;

namespace {

// 2 kg on 800 N/m and 8 N·s/m, its way "x" and its speed "v" seen.
sim::PlantSpec mass_on_spring() {
  return test::plant_of(test::mass_on(
      R"({"type": "spring", "body_a": "m",
          "parameters": {"stiffness": {"value": 800, "unit": "N/m"}}},
         {"type": "damper", "body_a": "m",
          "parameters": {"damping": {"value": 8, "unit": "N·s/m"}}})",
      "", "band_limited"));
}

// The sensor of "v" on a mount of 8 Hz and 5 %.
sim::PlantSpec with_loose_sensor() {
  return sim::with_effect(mass_on_spring(), "sensor_mount", {.channel = "v"},
                          {{"frequency", {8, "Hz"}}, {"damping_ratio", {0.05, "1"}}});
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
  // A ten-thousandth of the mass, ten times amplified where the mount rings.
  const Complex way = test::settled_line(firm[0], frequency_Hz);
  CHECK(std::abs(test::settled_line(loose[0], frequency_Hz) - way) < 1.5e-3 * std::abs(way));
  CHECK(with_loose_sensor().outputs[0].of == "m");
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
