#include <array>
#include <random>
#include <stdexcept>

#include "tests/latency/figures.hpp"
#include "tests/latency/running_bench.hpp"

namespace rvbench::test {
namespace {

// What an interlock can see first, by the three kinds of device.
constexpr std::array kinds{"safety input", "CAN bus", "DAQ"};

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
  std::array<std::vector<double>, kinds.size()> delays_ms;
  for (int trip = 0; trip < trips; ++trip) {
    RunningBench bench(rig, 600);
    bench.run_for(delay_s(random));
    plant.tap().forget_stop();
    const auto kind = std::size_t(trip) % kinds.size();
    const double struck_s = plant.look([&](FaultBench& light) {
      strike(light, int(kind));
      return plant.now_s();
    });
    if (!bench.run_until_tripped()) throw std::runtime_error("an interlock that did not trip");
    const Ending ending = *bench.supervisor().latched();
    if (ending.error_kind != ErrorKind::safety_trip || plant.tap().stop_seen_s() < struck_s) {
      throw std::runtime_error("no command to stop after a trip: " + ending.reason);
    }
    delays_ms[kind].push_back(1e3 * (plant.tap().stop_seen_s() - struck_s));
    bench.supervisor().end();
    plant.look([](FaultBench& light) { heal(light); });
    forget_samples(rig);
  }
  rig.drive->stop();
  std::vector<Figure> figures;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    const std::string what = std::string(kinds[kind]) + " to command to stop on the wire, ";
    figures.push_back({what + "p99", quantile(delays_ms[kind], 0.99), "ms", 20, 40});
    figures.push_back({what + "median", quantile(delays_ms[kind], 0.5), "ms"});
    figures.push_back({what + "longest", quantile(delays_ms[kind], 1), "ms"});
  }
  return figures;
}

}  // namespace rvbench::test
