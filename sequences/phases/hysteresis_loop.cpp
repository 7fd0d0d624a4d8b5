#include "sequences/phases/hysteresis_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "hal/json_object.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/plan.hpp"

namespace rvbench::sequences {
namespace {

constexpr double gripping_s = 2;  // until a brake holds what it is told
constexpr double standstill_rpm = 1;
constexpr double command_s = 0.1;

struct WindingSpec {
  double hold_pct = 0;
  double peak_pct = 0;
  double speed_rpm = 0;
  double least_speed_rpm = 0;
  double ramp_rpm_per_s = 0;
  int loops = 0;
  double timeout_s = 0;
};

// The speed commanded next: it changes evenly, and on its way from one side to the other leaves out
// what is so slow that a drive takes it for a stop and lets the shaft go.
class Winding {
 public:
  Winding(const WindingSpec& spec, double now_s) : spec_(spec), last_s_(now_s) {}

  double speed_rpm() const {
    const bool is_on_its_way = target_rpm_ != 0 && std::abs(speed_rpm_) < spec_.least_speed_rpm;
    return is_on_its_way ? std::copysign(spec_.least_speed_rpm, target_rpm_) : speed_rpm_;
  }

  /// @return whether there is a new speed to command
  bool towards(double target_rpm, double now_s) {
    if (now_s - last_s_ < command_s - 1e-6) return false;
    const double most_rpm = spec_.ramp_rpm_per_s * (now_s - last_s_);
    speed_rpm_ += std::clamp(target_rpm - speed_rpm_, -most_rpm, most_rpm);
    target_rpm_ = target_rpm;
    last_s_ = now_s;
    return true;
  }

 private:
  const WindingSpec& spec_;
  double last_s_;
  double speed_rpm_ = 0, target_rpm_ = 0;
};

class HysteresisLoop final : public Phase {
 public:
  explicit HysteresisLoop(const WindingSpec& spec) : spec_(spec) {}

  std::string_view kind() const override { return "hysteresis_loop"; }

  std::vector<hal::PlannedPoint> points() const override {
    return {{spec_.speed_rpm, spec_.peak_pct, 1}};
  }

  std::string to_json() const override {
    return hal::json_object({{"phase", kind()},
                             {"hold_pct", spec_.hold_pct},
                             {"peak_pct", spec_.peak_pct},
                             {"speed_rpm", spec_.speed_rpm},
                             {"least_speed_rpm", spec_.least_speed_rpm},
                             {"ramp_rpm_per_s", spec_.ramp_rpm_per_s},
                             {"loops", spec_.loops},
                             {"timeout_s", spec_.timeout_s}})
        .dump();
  }

  std::vector<Segment> timeline(const Specimen& specimen) const override {
    const double hold_Nm = load_torque_Nm(specimen, spec_.hold_pct);
    // At most: the peak turns it round before the speed does.
    const double winding_s =
        std::min(spec_.timeout_s, (4 * spec_.loops + 2) * spec_.speed_rpm / spec_.ramp_rpm_per_s);
    return {
        {fmt::format("hold the output with {:g} %", spec_.hold_pct), gripping_s, 0, hold_Nm, false},
        {fmt::format("wind to ±{:g} % and back, {} times", spec_.peak_pct, spec_.loops), winding_s,
         spec_.speed_rpm, hold_Nm, true}};
  }

  std::optional<Ending> run(BenchLoop& loop, const Specimen& specimen) override {
    const std::vector<Segment> segments = timeline(specimen);
    const double hold_Nm = segments.front().output_torque_Nm;
    const auto number = loop.next_point();
    loop.enter(segments.front());
    if (!number) {  // recorded before the run was interrupted
      loop.enter(segments.back());
      return std::nullopt;
    }
    loop.command(0, hold_Nm);
    const Waited stopped = loop.run_until(
        [&](const BenchValues&) { return loop.devices().stands_still(standstill_rpm); },
        spec_.timeout_s);
    if (stopped.ending) return stopped.ending;
    if (!stopped.met) return loop.give_up_point({*number, loop.now_s(), "unsettled"});
    if (auto ending = loop.run_for(gripping_s)) return ending;
    loop.enter(segments.back());
    auto ending = loop.record_work(*number, "not_wound_up", [&] { return wind(loop, specimen); });
    if (!ending) loop.command(0, hold_Nm);
    return ending;
  }

 private:
  // To one peak and the other in turn, and back to no speed.
  Waited wind(BenchLoop& loop, const Specimen& specimen) const {
    const double hold_Nm = load_torque_Nm(specimen, spec_.hold_pct);
    const double peak_Nm = load_torque_Nm(specimen, spec_.peak_pct) / specimen.gear_ratio;
    const double end_s = loop.now_s() + spec_.timeout_s;
    Winding winding(spec_, loop.now_s());
    const auto command_towards = [&](double target_rpm) {
      if (winding.towards(target_rpm, loop.now_s())) loop.command(winding.speed_rpm(), hold_Nm);
    };
    for (int peak = 0; peak <= 2 * spec_.loops; ++peak) {
      const double way = peak % 2 == 0 ? 1 : -1;
      const Waited waited = loop.run_until(
          [&](const BenchValues& values) {
            command_towards(way * spec_.speed_rpm);
            return way * values.torque_Nm >= peak_Nm;
          },
          end_s - loop.now_s());
      if (!waited.met) return waited;
    }
    return loop.run_until(
        [&](const BenchValues&) {
          command_towards(0);
          return winding.speed_rpm() == 0;
        },
        end_s - loop.now_s());
  }

  WindingSpec spec_;
};

}  // namespace

std::unique_ptr<Phase> parse_hysteresis_loop(hal::ConfigReader& json) {
  WindingSpec spec;
  spec.hold_pct = json.number("hold_pct", {1, 300});
  spec.peak_pct = json.number("peak_pct", {1, 300});
  spec.speed_rpm = json.number("speed_rpm", {0.1, 200});
  spec.least_speed_rpm = json.number("least_speed_rpm", {0, 200}, 0.5);
  spec.ramp_rpm_per_s = json.number("ramp_rpm_per_s", {0.01, 100});
  spec.loops = json.integer("loops", {1, 100}, 4);
  spec.timeout_s = json.number("timeout_s", {1, 3600}, 600);
  if (json.faults().empty() && spec.peak_pct >= spec.hold_pct) {
    json.fault("peak_pct", fmt::format("{:g} is not below hold_pct, {:g}: the brake would give way",
                                       spec.peak_pct, spec.hold_pct));
  }
  if (json.faults().empty() && spec.least_speed_rpm >= spec.speed_rpm) {
    json.fault("least_speed_rpm", "must be below speed_rpm");
  }
  return std::make_unique<HysteresisLoop>(spec);
}

}  // namespace rvbench::sequences
