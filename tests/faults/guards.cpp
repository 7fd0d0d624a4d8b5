#include "tests/faults/fault_bench.hpp"
#include "tests/faults/guard.hpp"
#include "tests/faults/kept_recording.hpp"

namespace rvbench::test {

const std::vector<Guard>& guards() {
  static const std::vector<Guard> all = [] {
    std::vector<Guard> named{
        {"limits",
         [](Controller& controller) {
           sequences::Interlocks& limits = controller.plan.interlocks;
           limits.acceleration_m_s2 = 0.99 * FaultBench::range_m_s2;
           limits.input_torque_Nm = 1e6;
           limits.housing_temp_degC = 1e6;
         }},
        {"staleness",
         [](Controller& controller) { controller.plan.interlocks.stale_after_s = 1e3; }},
        {"drained link", [](Controller& controller) { controller.forget_to_drain(); }},
        {"acknowledged once written",
         [](Controller& controller) { controller.recording.acknowledges_early = true; }},
        {"dead stretches",
         [](Controller& controller) { controller.check = flaw_but_dead_stretches; }},
        {"channels compared", [](Controller& controller) { controller.check = flaw_of_channels; }},
    };
    for (const auto& group : {guards_of_the_drive(), guards_of_the_field()}) {
      named.insert(named.end(), group.begin(), group.end());
    }
    return named;
  }();
  return all;
}

}  // namespace rvbench::test
