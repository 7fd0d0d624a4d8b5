#include <algorithm>
#include <stdexcept>

#include "hal/no_recording.hpp"
#include "sequences/silent_observer.hpp"
#include "tests/latency/figures.hpp"
#include "tests/latency/live_plant.hpp"
#include "tests/support/plan_of.hpp"

namespace rvbench::test {
namespace {

constexpr double standstill_timeout_s = 5;
const std::string plan_text = R"({
  "name": "release",
  "acceleration_rate_Hz": 1240,
  "specimen": {"kinematics": "rv20e", "gear_ratio": 2, "rated_output_torque_Nm": 10},
  "interlocks": {"input_speed_rpm": 2200, "input_torque_Nm": 8, "acceleration_m_s2": 300,
                 "housing_temp_degC": 60, "stale_after_s": 0.3},
  "setup": [{"phase": "connect"}],
  "main": [{"phase": "matrix", "speeds_rpm": [605], "loads_pct": [50],
            "settling": {"hold_s": 0.5, "timeout_s": 2}, "record": {"output_turns": 4}}],
  "teardown": {"standstill_timeout_s": 5}
})";

// From then on that it may be released until it was: by the plant.
double held_too_long_ms(bool is_deaf) {
  hal::Rig rig = make_live_plant_rig({});
  LivePlant& plant = live_plant(rig);
  hal::NoRecording nowhere;
  sequences::SilentObserver nobody;
  std::stop_source stop;
  plant.look([&](FaultBench& bench) {
    bench.when(BenchState::warming_up, 1, [&, is_deaf] {
      plant.tap().forget_stop();  // that of connect()
      if (!is_deaf) return;
      // It answers a stop as if it obeyed, and turns on until its watchdog acts.
      bench.server.inject({.fault = sim::WireFault::deaf});
      bench.disturbance.over_torque = true;
    });
  });
  const auto summary =
      sequences::run_sequence(plan_of(plan_text), rig, nowhere, nobody, stop.get_token());
  return plant.look([&](const FaultBench& bench) {
    if (bench.brake_Nm() > 0)
      throw std::runtime_error("the brake still holds: " + summary.ending.reason);
    const double may_release_s =
        std::min(bench.moved_until_s(), plant.tap().stop_seen_s() + standstill_timeout_s);
    return 1e3 * (bench.braked_until_s() - may_release_s);
  });
}

}  // namespace

std::vector<Figure> measure_release(int runs) {
  const Load load;
  std::vector<double> after_standstill_ms, after_timeout_ms;
  for (int run = 0; run < runs; ++run) after_standstill_ms.push_back(held_too_long_ms(false));
  for (int run = 0; run < runs; ++run) after_timeout_ms.push_back(held_too_long_ms(true));
  return {{"standstill until no torque is commanded at the brake", quantile(after_standstill_ms, 1),
           "ms", 200, 220},
          {"teardown's time-out until no torque is commanded", quantile(after_timeout_ms, 1), "ms",
           200, 220}};
}

}  // namespace rvbench::test
