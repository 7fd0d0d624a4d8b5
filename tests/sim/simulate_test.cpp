#include "sim/simulate.hpp"

#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "tests/sim/plant_texts.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;
using test::channel_of;
using test::mass_on;
using test::plant_of;
using test::run_of;

namespace {

constexpr double pi = std::numbers::pi;

const std::string spring = R"({"type": "spring", "body_a": "m",
  "parameters": {"stiffness": {"value": 800, "unit": "N/m"}}})";
const std::string damper = R"({"type": "damper", "body_a": "m",
  "parameters": {"damping": {"value": 6, "unit": "N·s/m"}}})";
const std::string cubic = R"({"type": "cubic_stiffness", "body_a": "m",
  "parameters": {"stiffness": {"value": 20000, "unit": "N/m³"}}})";

std::string dry_friction(double level_N, double creep_m_s) {
  return R"({"type": "coulomb_friction", "body_a": "m", "parameters": {
    "level": {"value": )" +
         std::to_string(level_N) + R"(, "unit": "N"},
    "creep_speed": {"value": )" +
         std::to_string(creep_m_s) + R"(, "unit": "m/s"}}})";
}

std::vector<Channel> silence(double rate_Hz, Eigen::Index n) {
  return {channel_of("u", "N", rate_Hz, Eigen::VectorXd::Zero(n))};
}

}  // namespace

SCENARIO("a linear oscillator is exact, however long the step", "[sim][simulate]") {
  // M = 2, k = 800, c = 6: ω0 = 20 rad/s, δ = 1.5 1/s.
  const double decay = 1.5, omega = std::sqrt(400 - 1.5 * 1.5);
  const auto plant = plant_of(mass_on(spring + "," + damper));
  const double rate_Hz = GENERATE(1000.0, 3.0);  // the latter: one sample per period
  const Eigen::VectorXd t = test::times_s(30, rate_Hz);
  WHEN("a constant force of 8 N comes at once") {
    const auto out =
        run_of(plant, {channel_of("u", "N", rate_Hz, Eigen::VectorXd::Constant(30, 8))});
    THEN("it rings about the static deflection of 1 cm") {
      for (Eigen::Index i = 0; i < 30; ++i) {
        const double ringing = std::exp(-decay * t[i]) *
                               (std::cos(omega * t[i]) + decay / omega * std::sin(omega * t[i]));
        CHECK(out[0].samples[i] == Approx(0.01 * (1 - ringing)).margin(1e-13));
      }
    }
  }
  WHEN("the force grows as t, sampled and joined by straight lines") {
    auto ramped = plant;
    ramped.inputs[0].between = sim::Between::linear;
    const auto out = run_of(ramped, {channel_of("u", "N", rate_Hz, t)});
    THEN("it lags by c/k behind t/k once the ringing is over, and rings as the closed form says") {
      for (Eigen::Index i = 0; i < 30; ++i) {
        const double s = std::sin(omega * t[i]), c = std::cos(omega * t[i]);
        const double lag = 6.0 / 800;
        // x = t/k − c/k² + e^{−δt}·(A·cos + B·sin), x(0) = 0, x'(0) = 0
        const double a = lag / 800, b = (decay * a - 1.0 / 800) / omega;
        const double x = (t[i] - lag) / 800 + std::exp(-decay * t[i]) * (a * c + b * s);
        CHECK(out[0].samples[i] == Approx(x).margin(1e-14));
      }
    }
  }
}

TEST_CASE("a band-limited force is followed between its samples", "[sim][simulate]") {
  // 120 Hz sampled at 500 Hz: straight lines between the samples would lose a fifth of it.
  const auto plant = plant_of(mass_on(spring + "," + damper, "", "band_limited"));
  const auto out = run_of(plant, {channel_of("u", "N", 500, test::tone(120, 5000, 500))});
  const double w = 2 * pi * 120;
  const std::complex<double> response = 1.0 / std::complex<double>(800 - 2 * w * w, 6 * w);
  // Once the start has died out (δ = 1.5 1/s, 8 s), away from the record's end.
  for (Eigen::Index i = 4500; i < 4900; ++i) {
    const double t = static_cast<double>(i) / 500;
    const double x = (response * std::polar(1.0, w * t)).real();
    CHECK(out[0].samples[i] == Approx(x).margin(2e-3 * std::abs(response)));
  }
}

TEST_CASE("a Duffing oscillator swings as Jacobi's cn", "[sim][simulate][literature]") {
  // x'' + 400·x + 10000·x³ = 0 from rest at 0.1: ω² = 400 + 10000·A², k² = 10000·A²/(2ω²).
  const double start_m = 0.1, omega = std::sqrt(500.0), modulus = std::sqrt(100.0 / 1000);
  const auto plant = plant_of(mass_on(spring + "," + cubic, R"("start_position_m": 0.1, )"));
  const auto out = run_of(plant, silence(50, 500));  // 10 s: some 34 periods, 15 samples each
  double farthest = 0;
  for (Eigen::Index i = 0; i < 500; ++i) {
    const double x = start_m * boost::math::jacobi_cn(modulus, omega * double(i) / 50);
    farthest = std::max(farthest, std::abs(out[0].samples[i] - x));
  }
  CHECK(farthest < 1e-3 * start_m);  // 5 millionths of a period in each period
}

TEST_CASE("a smooth nonlinear force converges with the fourth power of the step",
          "[sim][simulate]") {
  const auto plant = plant_of(mass_on(spring + "," + cubic, R"("start_position_m": 0.1, )"));
  const auto error = [&](int substeps) {
    const auto excitation =
        std::get<sim::Excitation>(sim::Excitation::make(plant, silence(50, 51), substeps));
    const auto result = std::get<sim::Simulated>(sim::simulate(plant, excitation));
    return result.channels[0].samples[50] -
           0.1 * boost::math::jacobi_cn(std::sqrt(0.1), std::sqrt(500.0));
  };
  const double coarse = error(4), middle = error(8), fine = error(16);
  CHECK(std::abs(fine) > 1e-12);  // there is something to converge
  CHECK(coarse / middle == Approx(16).epsilon(0.25));
  CHECK(middle / fine == Approx(16).epsilon(0.15));
}

SCENARIO("dry friction brings an oscillator to rest within a known number of swings",
         "[sim][simulate][literature]") {
  // Each half swing loses 2·T_c/k = 1 cm; from 4.7 cm: 3.7, 2.7, 1.7, 0.7, and 0.3 cm, where the
  // spring pulls with 2.4 N against friction of 4 N: it stays.
  const double creep_m_s = 1e-6;
  const auto plant = plant_of(
      mass_on(spring + "," + dry_friction(4, creep_m_s), R"("start_position_m": 0.047, )"));
  const double half_swing_s = pi / 20;
  const auto out = run_of(plant, silence(2000, 4000));
  const Eigen::VectorXd& x = out[0].samples;
  const std::vector<double> turns_m{0.047, -0.037, 0.027, -0.017, 0.007};
  for (std::size_t i = 0; i < turns_m.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(std::lround(double(i) * half_swing_s * 2000));
    CHECK(x[at] == Approx(turns_m[i]).margin(2e-5));
  }
  THEN("it sticks, and creeps no faster than the law lets it") {
    CHECK(x[3000] == Approx(0.003).margin(2e-5));
    CHECK(out[1].samples.tail(1000).cwiseAbs().maxCoeff() < creep_m_s);
  }
}

SCENARIO("a mass on dry friction moves only when pushed hard enough", "[sim][simulate][law]") {
  const auto plant = plant_of(mass_on(dry_friction(4, 1e-6)));
  const auto pushed = [&](double force_N) {
    return run_of(plant, {channel_of("u", "N", 100, Eigen::VectorXd::Constant(101, force_N))});
  };
  CHECK(pushed(0)[0].samples.norm() == 0);
  CHECK(std::abs(pushed(3.9)[0].samples[100]) < 3e-6);
  CHECK(pushed(5)[1].samples[100] == Approx((5 - 4) / 2.0).epsilon(1e-5));
  CHECK(pushed(-5)[1].samples[100] == Approx(-(5 - 4) / 2.0).epsilon(1e-5));
}

TEST_CASE("a mass bounces between the walls of a gap", "[sim][simulate][literature]") {
  // Free flight over 0.4 m at 1 m/s, half a swing in each wall's spring: a known period.
  const double stiffness = 20000, swing_s = pi * std::sqrt(2 / stiffness);
  const std::string gap = R"({"type": "backlash", "body_a": "m", "parameters": {
    "stiffness": {"value": 20000, "unit": "N/m"}, "gap": {"value": 0.4, "unit": "m"}}})";
  const auto out = run_of(plant_of(mass_on(gap, R"("start_speed_m_s": 1, )")), silence(400, 4001));
  const double period_s = 2 * (0.4 + swing_s);
  const Eigen::VectorXd& x = out[0].samples;
  for (int i = 0; i < 10; ++i) {
    const auto at = static_cast<Eigen::Index>(std::floor(i * period_s * 400));
    const double t = double(at) / 400 - i * period_s;  // before the wall: still in the gap
    // Each contact's time is right to 0.2 % of its duration.
    CHECK(x[at] == Approx(t).margin(1e-9 + 2 * i * 0.002 * swing_s));
  }
  CHECK(x.maxCoeff() == Approx(0.2 + 1 * std::sqrt(2 / stiffness)).margin(1e-4));
  CHECK(out[1].samples.cwiseAbs().maxCoeff() < 1 + 1e-3);  // it gains nothing
}

SCENARIO("inverse dynamics: what must push for a body to move as recorded", "[sim][simulate]") {
  auto plant = plant_of(R"({"plant": "slide",
    "bodies": [{"name": "m", "motion": "translation", "mass": {"value": 2, "unit": "kg"}}],
    "terms": [{"type": "viscous_friction", "body_a": "m",
               "parameters": {"damping": {"value": 6, "unit": "N·s/m"}}},
              {"type": "torque_offset", "body_a": "m",
               "parameters": {"level": {"value": -3, "unit": "N"}}}],
    "inputs": [{"channel": "q", "unit": "m", "is": "position", "body": "m", "band_Hz": 40}],
    "outputs": [{"channel": "volt", "unit": "V", "is": "drive", "body": "m",
                 "gain": {"value": 0.1, "unit": "V/N"}, "offset": {"value": 0.5, "unit": "V"}}]})");
  const double w = 2 * pi * 5;
  const Eigen::VectorXd t = test::times_s(2000, 1000);
  const Eigen::VectorXd q = 0.02 * (w * t.array()).sin();
  // The filter that differentiates lets its band through to within 5e-4.
  const double margin_V = 5e-4 * 0.1 * 2 * w * w * 0.02;
  const auto drive_N = [w](double at_s) {
    return -2 * w * w * 0.02 * std::sin(w * at_s) + 6 * w * 0.02 * std::cos(w * at_s) - 3;
  };
  WHEN("only the position is known") {
    const auto out = run_of(plant, {channel_of("q", "m", 1000, q)});
    for (Eigen::Index i = 200; i < 1800; ++i) {
      CHECK(out[0].samples[i] == Approx(0.1 * drive_N(t[i]) + 0.5).margin(margin_V));
    }
    CHECK(out[0].info.unit == "V");
    CHECK(out[0].rate_Hz == 1000);
  }
  WHEN("the position is noisy above the band that it is known in") {
    const auto noisy =
        run_of(plant, {channel_of("q", "m", 1000, q + 1e-5 * test::tone(200, 2000, 1000))});
    // 1e-5 m at 200 Hz would be 32 N, 3.2 V.
    for (Eigen::Index i = 200; i < 1800; ++i) {
      CHECK(noisy[0].samples[i] == Approx(0.1 * drive_N(t[i]) + 0.5).margin(3e-3));
    }
  }
  WHEN("the sensor answers 0.4 samples late") {
    plant.outputs[0].delay.value = 0.4e-3;
    const auto late = run_of(plant, {channel_of("q", "m", 1000, q)});
    for (Eigen::Index i = 200; i < 1800; ++i) {
      CHECK(late[0].samples[i] == Approx(0.1 * drive_N(t[i] - 0.4e-3) + 0.5).margin(margin_V));
    }
  }
  WHEN("it answers early: nothing jumps where the delay passes a whole sample, nor at the end") {
    const auto shifted = [&](double delay_s) {
      plant.outputs[0].delay.value = delay_s;
      return run_of(plant, {channel_of("q", "m", 1000, q)})[0].samples;
    };
    const Eigen::VectorXd at = shifted(-2e-3), beside = shifted(-2e-3 + 1e-8);
    const Eigen::VectorXd slope = (shifted(-1.9e-3) - at) / 1e-4;
    CHECK((beside - at).norm() <= 2 * 1e-8 * slope.norm());
  }
  WHEN("the speed is recorded instead") {
    plant.inputs[0] = {.name = "dq",
                       .channel = "dq",
                       .unit = "m/s",
                       .kind = sim::InputKind::speed,
                       .body = "m",
                       .gain = {1, "1", 0},
                       .offset = {0, "m/s", 0},
                       .band_Hz = 40};
    plant.outputs.push_back({.channel = "q",
                             .unit = "m",
                             .kind = sim::OutputKind::position,
                             .of = "m",
                             .gain = {1, "1", 0},
                             .offset = {0, "m", 0},
                             .delay = {0, "s", 0}});
    const auto out =
        run_of(plant, {channel_of("dq", "m/s", 1000, 0.02 * w * (w * t.array()).cos())});
    const double start_m = out[1].samples[200] - q[200];
    for (Eigen::Index i = 200; i < 1800; ++i) {
      CHECK(out[0].samples[i] == Approx(0.1 * drive_N(t[i]) + 0.5).margin(margin_V));
      CHECK(out[1].samples[i] - start_m == Approx(q[i]).margin(1e-5));
    }
  }
}

TEST_CASE("the same run gives the same bits, on a shared excitation too", "[sim][simulate]") {
  const auto plant = plant_of(mass_on(spring + "," + cubic + "," + dry_friction(0.5, 1e-4)));
  const std::vector<Channel> push{channel_of("u", "N", 500, test::white_noise(1000, 7))};
  const auto once = run_of(plant, push);
  const auto again = run_of(plant, push);
  CHECK(once[0].samples == again[0].samples);
  const int substeps = std::get<int>(sim::substeps_for(plant, 500));
  const auto shared = std::get<sim::Excitation>(sim::Excitation::make(plant, push, substeps));
  CHECK(std::get<sim::Simulated>(sim::simulate(plant, shared)).channels[0].samples ==
        once[0].samples);
}

SCENARIO("a run that cannot be made says why", "[sim][simulate]") {
  const auto fault_of = [](const sim::PlantSpec& plant, const std::vector<Channel>& inputs) {
    const auto result = sim::simulate(plant, inputs);
    REQUIRE(std::holds_alternative<hal::ConfigFault>(result));
    const auto& fault = std::get<hal::ConfigFault>(result);
    return fault.pointer + ": " + fault.message;
  };
  auto plant = plant_of(mass_on(spring));
  const auto good = silence(100, 50);
  CHECK(std::holds_alternative<sim::Simulated>(sim::simulate(plant, good)));

  auto other = good;
  other[0].info.name = "w";
  CHECK(fault_of(plant, other) == "/inputs/0/channel: the recording has no channel \"u\"");
  other = good;
  other[0].info.unit = "V";
  CHECK(fault_of(plant, other) ==
        "/inputs/0/channel: channel \"u\" is in \"V\", the plant expects \"N\"");
  other = good;
  other[0].rate_Hz = 0;
  CHECK_THAT(fault_of(plant, other), Catch::Contains("rate of channel \"u\" is not known"));
  other = good;
  other[0].samples[3] = NAN;
  CHECK_THAT(fault_of(plant, other), Catch::Contains("1 samples that are not finite"));
  other = good;
  other[0].samples.resize(1);
  CHECK_THAT(fault_of(plant, other), Catch::Contains("fewer than 2 samples"));

  plant.bodies[0].inertia.value = -1;
  CHECK(fault_of(plant, good) == "/bodies/0/mass/value: -1 must be above 0");
  plant.bodies[0].inertia.value = NAN;
  CHECK(fault_of(plant, good) == "/bodies/0/mass/value: must be finite");

  // Left of x = 0 this spring pushes away, the harder the farther: infinity after a finite time.
  plant = plant_of(mass_on(R"({"type": "quadratic_stiffness", "body_a": "m",
    "parameters": {"stiffness": {"value": 100, "unit": "N/m²"}}})",
                           R"("start_position_m": -1, )"));
  CHECK_THAT(fault_of(plant, silence(100, 500)), Catch::StartsWith("/terms: unstable: "));
  plant = plant_of(mass_on(R"({"type": "backlash", "body_a": "m", "parameters": {
    "stiffness": {"value": 1e20, "unit": "N/m"}, "gap": {"value": 0.4, "unit": "m"}}})"));
  CHECK_THAT(fault_of(plant, good), Catch::StartsWith("/terms: too stiff: "));
}
