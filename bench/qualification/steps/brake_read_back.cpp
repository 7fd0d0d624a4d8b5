#include <fmt/format.h>

#include <cmath>

#include "bench/qualification/self_test_steps.hpp"
#include "bench/qualification/slow_turning.hpp"

namespace rvbench::bench {
namespace {

/// The brake is told a torque while the shaft turns slowly: it must tell as much, and the
/// transducer at the input must show what the gear ratio makes of it.
///
///     ΔT_in·i / ΔT_brake − 1    0 without losses; a reducer's own lie within the tolerance
class BrakeReadBack final : public SelfTestStep {
 public:
  std::string_view name() const override { return "brake_read_back"; }

  sequences::Segment segment(const SelfTestSpec& spec) const override {
    return {fmt::format("brake with {:g} N·m at {:g} rpm", spec.brake_torque_Nm, spec.speed_rpm),
            2 * slow_turning_s(), spec.speed_rpm, spec.brake_torque_Nm, false};
  }

  std::optional<Ending> run(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                            SelfTestResult& result) override {
    SlowTurning idle, loaded;
    if (auto ending = turn_slowly(loop, spec, 0, idle)) return ending;
    if (auto ending = turn_slowly(loop, spec, spec.brake_torque_Nm, loaded)) return ending;
    if (auto ending = come_to_rest(loop, spec.brake_torque_Nm).ending) return ending;
    if (!(loaded.angle_rpm > 0.5 * spec.speed_rpm)) {
      result.reason = fmt::format(
          "the shaft does not turn as told, {:.4g} of {:g} rpm: no torque "
          "of the brake's would show",
          loaded.angle_rpm, spec.speed_rpm);
      return std::nullopt;
    }
    const double told_Nm = loaded.brake_Nm;
    const double grown_Nm = loaded.torque_Nm - idle.torque_Nm;
    const double asked_Nm = spec.brake_torque_Nm / spec.gear_ratio;
    result.readings.push_back(at_most("input_torque", 100 * std::abs(grown_Nm / asked_Nm - 1),
                                      spec.torque_tolerance_pct, "%"));
    // One that does not say what it holds is judged by the transducer alone.
    if (std::isfinite(told_Nm)) {
      result.readings.push_back(at_most("brake", 100 * std::abs(told_Nm / spec.brake_torque_Nm - 1),
                                        spec.brake_tolerance_pct, "%"));
    }
    conclude(result, fmt::format("off the {:g} N·m commanded", spec.brake_torque_Nm));
    result.reason += fmt::format(
        "; the brake told {:.4g} N·m, the transducer {:.3g} N·m more than idle, {:.3g} without "
        "losses",
        told_Nm, grown_Nm, asked_Nm);
    return std::nullopt;
  }
};

}  // namespace

std::unique_ptr<SelfTestStep> make_brake_read_back() { return std::make_unique<BrakeReadBack>(); }

}  // namespace rvbench::bench
