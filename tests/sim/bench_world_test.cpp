#include "sim/bench_world.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "analysis/spectrum.hpp"
#include "hal/can/can_frames.hpp"
#include "tests/support/signals.hpp"

using namespace rvbench;

namespace {

constexpr Eigen::Index samples_per_s = 496;
constexpr int scans_per_sample = 10;
constexpr double noise_Nm = 0.002;
constexpr double noise_factor = 1.5;  // from bench to bench, each way

// What shaft and transducer show while the bench does what it does.
struct Watched {
  Eigen::VectorXd shaft_Nm;    // at the rate of the accelerations
  Eigen::VectorXd samples_Nm;  // of the transducer
};

Watched watch(sim::BenchWorld& world, hal::CanTransport& bus, Eigen::Index samples) {
  Watched watched{Eigen::VectorXd(samples * scans_per_sample), Eigen::VectorXd(samples)};
  Eigen::Index taken = 0;
  const double start_s = world.now_s();
  for (Eigen::Index i = 0; i < watched.shaft_Nm.size(); ++i) {
    world.advance_to(start_s + (double(i) + 1.5) / sim::RvBench::rate_Hz);
    watched.shaft_Nm[i] = world.plant().input_torque_Nm();
    while (const auto frame = bus.receive()) {
      const auto torque = hal::can_frames::torque_from_frame(frame.value());
      if (torque && taken < samples) watched.samples_Nm[taken++] = torque->torque_Nm;
    }
  }
  REQUIRE(taken == samples);
  return watched;
}

Eigen::VectorXd standstill_Nm(std::uint64_t seed) {
  sim::BenchWorld world(sim::draw_unit("healthy", seed));
  const auto bus = world.make_can_transport();
  return watch(world, *bus, 2 * samples_per_s).samples_Nm;
}

}  // namespace

SCENARIO("the simulated transducer shows no line that the shaft does not have", "[sim]") {
  GIVEN("a bench at 1830 rpm, with mesh lines at several times the transducer's band") {
    sim::BenchWorld world(sim::draw_unit("healthy", 1), {.comm_loss_timeout_s = 0});
    const auto bus = world.make_can_transport();
    REQUIRE(world.inverter().command(sim::RunCommand::forward, 61.5));
    world.advance_to(8);
    while (bus->receive()) {
    }
    const Watched watched = watch(world, *bus, 4 * samples_per_s);
    const auto shaft = analysis::amplitude_spectrum(watched.shaft_Nm, sim::RvBench::rate_Hz,
                                                    analysis::Window::hann);
    const auto shown =
        analysis::amplitude_spectrum(watched.samples_Nm, samples_per_s, analysis::Window::hann);
    const auto highest = static_cast<Eigen::Index>(0.4 * samples_per_s / shown.resolution);
    REQUIRE(shaft.amplitude.tail(shaft.amplitude.size() - 2 * highest).maxCoeff() > 0.01);
    THEN("below 0.4 of its rate each line has the shaft's amplitude, within the noise's largest") {
      const Eigen::VectorXd apart =
          shown.amplitude.segment(1, highest) - shaft.amplitude.segment(1, highest);
      CHECK(apart.cwiseAbs().maxCoeff() < 0.0006);
    }
    THEN("the mean is the shaft's") {
      CHECK(watched.samples_Nm.mean() == Approx(watched.shaft_Nm.mean()).margin(0.0005));
    }
  }
}

SCENARIO("the simulated transducer has noise, which the seed draws", "[sim]") {
  const Eigen::VectorXd samples_Nm = standstill_Nm(1);
  THEN("at standstill it is all that shows, 0.01 % of a range of 20 N·m") {
    CHECK(test::rms(samples_Nm) > noise_Nm / noise_factor / 1.1);
    CHECK(test::rms(samples_Nm) < noise_Nm * noise_factor * 1.1);
  }
  THEN("the same seed gives the same samples") { CHECK(standstill_Nm(1) == samples_Nm); }
  THEN("another seed gives others") {
    const Eigen::VectorXd others_Nm = standstill_Nm(2);
    const double alike = samples_Nm.dot(others_Nm) / (samples_Nm.norm() * others_Nm.norm());
    CHECK(std::abs(alike) < 0.2);
  }
}
