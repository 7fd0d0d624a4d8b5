#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "sim/effect_sites.hpp"
#include "tests/sim/plant_texts.hpp"

namespace rvbench::sim {
namespace {

constexpr double field_rad_s = 50 * std::numbers::pi;  // 50 Hz, two pole pairs

// A rotor on a drive of 10 N·m, and a brake.
PlantSpec driven() {
  return test::plant_of(R"({"plant": "motor",
    "bodies": [{"name": "rotor", "motion": "rotation", "inertia": {"value": 0.02, "unit": "kg·m²"},
                "start_speed_rad_s": 150}],
    "terms": [{"type": "synchronous_drive", "body_a": "rotor", "name": "drive",
               "parameters": {"speed": {"value": 157.07963267948966, "unit": "rad/s"},
                              "rated_torque": {"value": 10, "unit": "N·m"}}},
              {"type": "viscous_friction", "body_a": "rotor",
               "parameters": {"damping": {"value": 0, "unit": "N·m·s/rad"}}}],
    "inputs": [{"channel": "brake", "unit": "N·m", "is": "force", "body": "rotor",
                "gain": {"value": -1, "unit": "1"}}],
    "outputs": [{"channel": "v", "unit": "rad/s", "is": "speed", "body": "rotor"}]})");
}

PlantSpec slipping(double rated_slip) {
  const PlantSpec plant = driven();
  const auto sites = sites_of(plant, *standard_terms().find("slip"));
  REQUIRE(sites.size() == 1);
  return with_effect(plant, "slip", sites[0], {{"rated_slip", {rated_slip, "1"}}});
}

double steady_rad_s(const PlantSpec& plant, double brake_Nm) {
  const auto run = test::run_of(
      plant, {test::channel_of("brake", "N·m", 10, Eigen::VectorXd::Constant(100, brake_Nm))});
  return run[0].samples[99];
}

}  // namespace

TEST_CASE("a motor slips along the foot of Kloss' curve", "[sim][library][literature]") {
  // Pull-out at 2.5 times the rated torque and 15 % of slip.
  const double pull_out_Nm = 25, pull_out_slip = 0.15;
  const PlantSpec plant = slipping(pull_out_slip * 10 / (2 * pull_out_Nm));
  for (const double slip : {-0.004, 0.002, 0.004}) {
    const double kloss_Nm = 2 * pull_out_Nm / (slip / pull_out_slip + pull_out_slip / slip);
    CHECK(1 - steady_rad_s(plant, kloss_Nm) / field_rad_s == Approx(slip).epsilon(1e-3));
  }
}

TEST_CASE("a synchronous drive keeps its speed at any torque", "[sim][library][null]") {
  for (const double brake_Nm : {-10.0, 0.0, 10.0}) {
    CHECK(steady_rad_s(driven(), brake_Nm) == Approx(field_rad_s).epsilon(2e-6));
  }
  CHECK(steady_rad_s(slipping(0), 10) == Approx(field_rad_s).epsilon(2e-6));
}

TEST_CASE("slip comes into step as fast as rotor and air gap make it", "[sim][library]") {
  // J·dv/dt = −T_r/s_r·(v/ω_s − 1)
  const double time_s = 0.04 * 0.2 * field_rad_s / 10;
  PlantSpec plant = slipping(0.2);
  plant.bodies[0].inertia.value = 0.04;
  const auto run =
      test::run_of(plant, {test::channel_of("brake", "N·m", 100, Eigen::VectorXd::Zero(50))});
  for (const Eigen::Index i : {5, 10, 40}) {
    const double expected =
        field_rad_s - (field_rad_s - 150) * std::exp(-0.01 * double(i) / time_s);
    CHECK(run[0].samples[i] == Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("slip takes the place of a synchronous drive, and is tried nowhere else",
          "[sim][explain]") {
  const TermType& slip = *standard_terms().find("slip");
  const PlantSpec plant = slipping(0.04);
  REQUIRE(plant.terms.size() == 2);
  CHECK(plant.terms[0].type == "slip");
  CHECK(plant.terms[0].name == "drive");
  CHECK(plant.terms[0].parameters.at("speed").value == Approx(field_rad_s));
  CHECK(plant.terms[0].parameters.at("rated_torque").value == 10);
  CHECK(sites_of(plant, slip).empty());
}

}  // namespace rvbench::sim
