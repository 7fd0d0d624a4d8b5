#include <random>
#include <stdexcept>

#include "tests/latency/figures.hpp"
#include "tests/latency/running_bench.hpp"

namespace rvbench::test {
namespace {

constexpr double watchdog_s = 0.5;
// It counts from the last request that came through, acts in the plant's next step of 1 ms, and
// the thread that turns the plant may be woken late.
constexpr double step_s = 0.001;
constexpr double scheduling_s = 0.01;
constexpr double acts_within_s = watchdog_s + step_s + scheduling_s;
constexpr double promised_s = 2;  // the slowest watchdog that a plan arms with by default

struct Loss {
  double found_s = 0;     ///< after the cable was pulled
  double undriven_s = 0;  ///< likewise, by the plant
};

Loss lose_link(double after_s) {
  hal::Rig rig = make_live_plant_rig({.comm_loss_timeout_s = watchdog_s});
  LivePlant& plant = live_plant(rig);
  connect(rig);
  RunningBench bench(rig, 600);
  bench.run_for(2 + after_s);  // the drive's ramp is over by then
  plant.tap().pull();
  const double pulled_s = plant.now_s();
  if (!bench.run_until_tripped()) throw std::runtime_error("a dead link was not found");
  Loss loss;
  loss.found_s = bench.supervisor().latched_s() - pulled_s;
  // The controller can do no more: the drive's own watchdog must.
  rig.clock->wait_until(pulled_s + 3);
  loss.undriven_s =
      plant.look([](const FaultBench& light) { return light.driven_until_s(); }) - pulled_s;
  return loss;
}

}  // namespace

std::vector<Figure> measure_link_loss(int losses) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> after_s(0, 0.1);
  std::vector<double> found_ms, undriven_s;
  const Load load;
  for (int i = 0; i < losses; ++i) {
    const Loss loss = lose_link(after_s(random));
    found_ms.push_back(1e3 * loss.found_s);
    undriven_s.push_back(loss.undriven_s);
  }
  return {{"cable pulled until the run is ended, longest", quantile(found_ms, 1), "ms", 300, 320},
          {"cable pulled until the drive's watchdog acts, longest", quantile(undriven_s, 1), "s",
           acts_within_s, acts_within_s + scheduling_s},
          {"the same, promised: the slowest watchdog it arms with", promised_s, "s"}};
}

}  // namespace rvbench::test
