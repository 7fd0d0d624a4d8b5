#include <fmt/format.h>

#include <cmath>

#include "bench/qualification/self_test_steps.hpp"
#include "bench/qualification/slow_turning.hpp"

namespace rvbench::bench {
namespace {

/// The drive is told a small speed; what it says it does and what the transducer's angle shows
/// must agree with that, and after a stop the shaft must stand.
class DriveReadBack final : public SelfTestStep {
 public:
  std::string_view name() const override { return "drive_read_back"; }

  sequences::Segment segment(const SelfTestSpec& spec) const override {
    return {fmt::format("turn at {:g} rpm and stop", spec.speed_rpm), slow_turning_s(),
            spec.speed_rpm, 0, false};
  }

  std::optional<Ending> run(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                            SelfTestResult& result) override {
    SlowTurning seen;
    if (auto ending = turn_slowly(loop, spec, 0, seen)) return ending;
    const sequences::Waited stopped = come_to_rest(loop, 0);
    if (stopped.ending) return stopped.ending;
    const auto off_pct = [&](double speed_rpm) {
      return 100 * std::abs(speed_rpm - spec.speed_rpm) / spec.speed_rpm;
    };
    result.readings.push_back(
        at_most("input_angle", off_pct(seen.angle_rpm), spec.speed_tolerance_pct, "%"));
    // Some drives do not tell a speed: the angle alone has to do.
    if (std::isfinite(seen.drive_rpm)) {
      result.readings.push_back(
          at_most("drive", off_pct(seen.drive_rpm), spec.speed_tolerance_pct, "%"));
    }
    conclude(result, fmt::format("off the {:g} rpm commanded", spec.speed_rpm));
    result.reason += fmt::format("; the angle showed {:.4g} rpm, the drive told {:.4g}",
                                 seen.angle_rpm, seen.drive_rpm);
    if (!stopped.met) {
      result.word = SelfTestWord::failed;
      result.reason = "the shaft does not stand after a stop; " + result.reason;
    }
    return std::nullopt;
  }
};

}  // namespace

std::unique_ptr<SelfTestStep> make_drive_read_back() { return std::make_unique<DriveReadBack>(); }

}  // namespace rvbench::bench
