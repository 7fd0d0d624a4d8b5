#include "sim/random_vibration.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "analysis/squared_envelope.hpp"
#include "sim/excitation.hpp"
#include "sim/simulate.hpp"
#include "sim/term_library.hpp"
#include "tests/support/bearing_seat.hpp"
#include "tests/support/under_sanitizer.hpp"

using namespace rvbench;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double shaft_Hz = 30;

sim::PlantSpec seat_with(const sim::Parameters& bearing) {
  return test::bearing_seat(bearing, 5100);
}

sim::RandomVibration vibration_of(const sim::PlantSpec& plant) {
  auto made = sim::RandomVibration::make(plant);
  if (auto* fault = std::get_if<hal::ConfigFault>(&made)) FAIL(fault->pointer + fault->message);
  return std::get<sim::RandomVibration>(std::move(made));
}

constexpr sim::FrequencyBand band{300, 5100, 5};
const Eigen::VectorXd turning = Eigen::VectorXd::Constant(1, shaft_Hz);

double depth_at(const sim::Vibration& vibration, double order) {
  for (const auto& swell : vibration.swells) {
    if (std::abs(swell.frequency_Hz - order * shaft_Hz) < 1e-6) return swell.depth;
  }
  return 0;
}

sim::Parameters spall_on(double part) {
  return {{"spalled_part", {part, "1"}}, {"impact_impulse", {2e-3, "N·s"}}};
}

// What an accelerometer records of the plant.
Eigen::VectorXd recorded(const sim::PlantSpec& plant, double length_s, double rate_Hz) {
  const auto samples = static_cast<Eigen::Index>(length_s * rate_Hz);
  const Channel speed{
      {"shaft_speed", "Hz", "", 1}, rate_Hz, 0, Eigen::VectorXd::Constant(samples, shaft_Hz)};
  const int steps = std::get<int>(sim::substeps_for(plant, rate_Hz));
  const auto made = sim::Excitation::make(plant, {speed}, steps);
  const auto run = sim::simulate(plant, std::get<sim::Excitation>(made));
  return std::get<sim::Simulated>(run).channels.at(0).samples;
}

}  // namespace

TEST_CASE("one mass shows its own resonance curve times the force's density", "[sim]") {
  const sim::PlantSpec plant = seat_with({});
  const sim::Vibration shown = vibration_of(plant).under(turning, 0, band);
  for (const double f_Hz : {300.0, 1000.0, 2010.0, 4000.0}) {
    const double w = 2 * pi * f_Hz;
    const double compliance = 1 / (std::pow(1.6e8 - w * w, 2) + std::pow(2000 * w, 2));
    const double held = std::sin(pi * f_Hz * 20e-6) / (pi * f_Hz * 20e-6);
    const double force = 4 / (2 * pi * 1000) * held * held / (1 + std::pow(f_Hz / 1000, 2));
    CHECK(shown.density[Eigen::Index((f_Hz - 300) / 5)] ==
          Approx(std::pow(w, 4) * compliance * force).epsilon(1e-9));
  }
  CHECK(shown.swells.empty());
}

TEST_CASE("a spall on each part strikes at the orders that the rig's makers publish", "[sim]") {
  struct Published {
    double part, order;
  };
  for (const auto& [part, order] : {Published{1, 3.5848}, {2, 5.4152}, {3, 4.7135}}) {
    const sim::Vibration shown = vibration_of(seat_with(spall_on(part))).under(turning, 0, band);
    REQUIRE_FALSE(shown.swells.empty());
    CHECK(shown.swells.front().frequency_Hz / shaft_Hz == Approx(order).epsilon(2e-4));
    CHECK(shown.swells.front().depth > 1);
  }
}

TEST_CASE("blows swell as their part goes through the load zone", "[sim]") {
  struct Part {
    double part, passes, loads;
  };
  for (const auto& [part, passes, loads] :
       {Part{1, 3.58483, 0}, {2, 5.41517, 1}, {3, 4.71344, 0.39831}}) {
    sim::Parameters bearing = spall_on(part);
    bearing["load_zone_once"] = {0.6, "1"};
    const sim::Vibration shown = vibration_of(seat_with(bearing)).under(turning, 0, band);
    INFO("part " << part);
    for (const auto& swell : shown.swells) {
      const double beside = std::abs(swell.frequency_Hz / shaft_Hz - passes);
      if (beside > 1e-3 && beside < 1.5) CHECK(beside == Approx(loads).epsilon(1e-3));
    }
  }
}

TEST_CASE("two bearings shake twice as much as one, in a simulation too", "[sim]") {
  if (test::too_long_under_sanitizer()) return;
  const sim::PlantSpec one = seat_with({});
  sim::PlantSpec two = one;
  two.terms.push_back(two.terms.back());
  two.terms.back().name = "other bearing";
  two.terms.back().parameters["seed"].value = 1;
  const auto power = [](const sim::PlantSpec& plant) {
    return analysis::band_vibration(recorded(plant, 10, 48000), 48000, 300, 5100, 1).mean_square[0];
  };
  CHECK(power(two) / power(one) == Approx(2).epsilon(0.1));
  CHECK(vibration_of(two).under(turning, 0, band).density.sum() ==
        Approx(2 * vibration_of(one).under(turning, 0, band).density.sum()));
}

TEST_CASE("of a swell that is faster than the structure rings, less is left", "[sim]") {
  sim::Parameters swelling{{"load_zone_once", {0.5, "1"}}};
  sim::PlantSpec plant = seat_with(swelling);
  const double damped = depth_at(vibration_of(plant).under(turning, 0, band), 1);
  plant.terms[1].parameters["damping"].value = 100;  // rings for 20 ms, a shaft turns in 33
  const double ringing = depth_at(vibration_of(plant).under(turning, 0, band), 1);
  CHECK(damped == Approx(0.5).epsilon(0.05));
  CHECK(ringing < 0.5 * damped);
}

TEST_CASE("what is solved is what a long simulation shows", "[sim]") {
  if (test::too_long_under_sanitizer()) return;
  sim::Parameters bearing = spall_on(2);
  bearing["load_zone_twice"] = {0.3, "1"};
  bearing["impact_scatter"] = {0.04, "1"};
  const sim::PlantSpec plant = seat_with(bearing);
  const sim::Vibration solved = vibration_of(plant).under(turning, 0, band);
  const Eigen::VectorXd x = recorded(plant, 26, 48000);
  const auto shown = analysis::band_vibration(x, 48000, 300, 5100, 4);
  const Eigen::Index part = band.size() / 4;
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double power = solved.density.segment(i * part, part).sum() * band.step_Hz;
    CHECK(10 * std::log10(shown.mean_square[i] / power) == Approx(0).margin(0.5));
  }
  for (const double order : {2.0, 5.41523, 2 * 5.41523}) {
    const auto measured = analysis::depth_near(shown.depth, order * shaft_Hz, 1);
    const double expected = [&] {
      double depth = 0;
      for (const auto& swell : solved.swells) {
        if (std::abs(swell.frequency_Hz - order * shaft_Hz) < 0.5) depth = swell.depth;
      }
      return depth;
    }();
    CHECK(measured.depth == Approx(expected).epsilon(0.12));
  }
  CHECK(analysis::depth_near(shown.depth, 3.5848 * shaft_Hz, 1).depth < 0.05);
}

TEST_CASE("what cannot be solved says why", "[sim]") {
  sim::PlantSpec plant = seat_with({});
  const auto why = [](const sim::PlantSpec& of) {
    const auto made = sim::RandomVibration::make(of);
    const auto* fault = std::get_if<hal::ConfigFault>(&made);
    return fault == nullptr ? std::string() : fault->pointer + ": " + fault->message;
  };
  CHECK(why(plant).empty());
  sim::PlantSpec hard = plant;
  hard.terms.push_back(
      {"bump", "cubic_stiffness", "seat", "housing", "", {{"stiffness", {1, "N/m³"}}}});
  CHECK(why(hard).starts_with("/terms/3: what cubic_stiffness makes of a random vibration"));
  sim::PlantSpec driven = plant;
  driven.terms[1].parameters["damping"].value = -2000;
  CHECK_FALSE(why(driven).empty());
}
