#include <array>
#include <random>
#include <stdexcept>

#include "tests/latency/figures.hpp"
#include "tests/latency/running_bench.hpp"

namespace rvbench::test {
namespace {

// What an interlock can see first, by the three kinds of device: input, bus and DAQ.
void strike(FaultBench& bench, int kind) {
  if (kind == 0) bench.safety.estop_pressed = true;
  if (kind == 1) bench.disturbance.over_torque = true;
  if (kind == 2) bench.disturbance.spike = true;
}

void heal(FaultBench& bench) {
  bench.safety.estop_pressed = false;
  bench.disturbance = {};
}

// What was beyond a limit a moment ago is no reason for the next trip.
void forget_samples(hal::Rig& rig) {
  rig.clock->wait_until(rig.clock->now_s() + 0.01);
  (void)rig.torque_sensor->read();
  (void)rig.accelerometers->read();
}

}  // namespace

std::vector<Figure> measure_trips(int trips) {
  hal::Rig rig = make_live_plant_rig({.ramp_up_Hz_per_s = 100, .ramp_down_Hz_per_s = 100});
  LivePlant& plant = live_plant(rig);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> delay_s(0.02, 0.08);
  connect(rig);
  const Load load;
  std::vector<double> delays_ms;
  for (int trip = 0; trip < trips; ++trip) {
    RunningBench bench(rig, 600);
    bench.run_for(delay_s(random));
    plant.tap.forget_stop();
    const double struck_s = plant.look([&](FaultBench& light) {
      strike(light, trip % 3);
      return plant.now_s();
    });
    if (!bench.run_until_tripped()) throw std::runtime_error("an interlock that did not trip");
    const Ending ending = *bench.supervisor().latched();
    if (ending.error_kind != ErrorKind::safety_trip || plant.tap.stop_seen_s() < struck_s) {
      throw std::runtime_error("no command to stop after a trip: " + ending.reason);
    }
    delays_ms.push_back(1e3 * (plant.tap.stop_seen_s() - struck_s));
    bench.supervisor().end();
    plant.look([](FaultBench& light) { heal(light); });
    forget_samples(rig);
  }
  rig.drive->stop();
  return {{"interlock to command on the wire, p99", quantile(delays_ms, 0.99), "ms", 20, 40},
          {"interlock to command on the wire, median", quantile(delays_ms, 0.5), "ms"},
          {"interlock to command on the wire, longest", quantile(delays_ms, 1), "ms"}};
}

}  // namespace rvbench::test
