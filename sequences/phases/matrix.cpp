#include "sequences/phases/matrix.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "hal/json_object.hpp"
#include "sequences/bench_loop.hpp"
#include "sequences/plan.hpp"
#include "sequences/settling.hpp"

namespace rvbench::sequences {
namespace {

constexpr double most_points = 10000;

struct MatrixSpec {
  std::vector<double> speeds_rpm;
  std::vector<double> loads_pct;
  int repeats = 1;
  std::string order;
  int seed = 0;  // of "randomised"
  SettlingRule settling;
  double output_turns = 0;
};

std::vector<hal::PlannedPoint> make_points(const MatrixSpec& spec) {
  std::vector<hal::PlannedPoint> points;
  for (const double speed_rpm : spec.speeds_rpm) {
    for (int repeat = 1; repeat <= spec.repeats; ++repeat) {
      for (const double load_pct : spec.loads_pct) points.push_back({speed_rpm, load_pct, repeat});
    }
  }
  if (spec.order == "randomised") {
    // Fisher-Yates by hand: std::shuffle may differ from one library to the next.
    std::mt19937_64 random(std::uint64_t(spec.seed));
    for (std::size_t left = points.size(); left > 1; --left) {
      std::swap(points[left - 1], points[random() % left]);
    }
  }
  return points;
}

class Matrix final : public Phase {
 public:
  explicit Matrix(MatrixSpec spec) : spec_(std::move(spec)), points_(make_points(spec_)) {}

  std::string_view kind() const override { return "matrix"; }
  std::vector<hal::PlannedPoint> points() const override { return points_; }

  std::string to_json() const override {
    const SettlingRule& rule = spec_.settling;
    nlohmann::ordered_json json = hal::json_object({{"phase", kind()},
                                                    {"speeds_rpm", spec_.speeds_rpm},
                                                    {"loads_pct", spec_.loads_pct},
                                                    {"repeats", spec_.repeats},
                                                    {"order", spec_.order}});
    if (spec_.order == "randomised") json["seed"] = spec_.seed;
    json["settling"] = hal::json_object({{"speed_tolerance_pct", rule.speed_tolerance_pct},
                                         {"load_tolerance_pct", rule.load_tolerance_pct},
                                         {"speed_band_pct", rule.speed_band_pct},
                                         {"torque_band_pct", rule.torque_band_pct},
                                         {"torque_band_Nm", rule.torque_band_Nm},
                                         {"hold_s", rule.hold_s},
                                         {"timeout_s", rule.timeout_s}});
    json["record"] = hal::json_object({{"output_turns", spec_.output_turns}});
    return json.dump();
  }

  std::vector<Segment> timeline(const Specimen& specimen) const override {
    std::vector<Segment> segments;
    for (const hal::PlannedPoint& point : points_) {
      segments.push_back(settle_segment(point, specimen));
      segments.push_back(record_segment(point, specimen));
    }
    return segments;
  }

  std::optional<Ending> run(BenchLoop& loop, const Specimen& specimen) override {
    for (const hal::PlannedPoint& point : points_) {
      const Segment settle = settle_segment(point, specimen);
      const Segment record = record_segment(point, specimen);
      const auto number = loop.next_point();
      loop.enter(settle);
      if (!number) {  // recorded before the run was interrupted
        loop.enter(record);
        continue;
      }
      loop.command(settle.speed_rpm, settle.output_torque_Nm);
      Settling settling(spec_.settling, point.speed_rpm);
      const auto settled = settle_point(loop, settling, settle, specimen);
      if (settled.ending) return settled.ending;
      loop.enter(record);
      if (!settled.met) {
        if (auto ending =
                loop.give_up_point({*number, loop.now_s(), "unsettled", settling.mean_speed_rpm(),
                                    settling.mean_torque_Nm()})) {
          return ending;
        }
        continue;
      }
      // Half as long again: by then the speed has left the plan's by far.
      if (auto ending = loop.record_point(*number, spec_.output_turns * specimen.gear_ratio,
                                          1.5 * record.duration_s)) {
        return ending;
      }
    }
    return std::nullopt;
  }

 private:
  Segment settle_segment(const hal::PlannedPoint& point, const Specimen& specimen) const {
    return {fmt::format("settle at {:g} rpm, {:g} %", point.speed_rpm, point.load_pct),
            spec_.settling.hold_s, point.speed_rpm, load_torque_Nm(specimen, point.load_pct),
            false};
  }

  Segment record_segment(const hal::PlannedPoint& point, const Specimen& specimen) const {
    return {fmt::format("record {:g} rpm, {:g} %, repeat {}", point.speed_rpm, point.load_pct,
                        point.repeat),
            spec_.output_turns * specimen.gear_ratio * 60 / point.speed_rpm, point.speed_rpm,
            load_torque_Nm(specimen, point.load_pct), true};
  }

  Waited settle_point(BenchLoop& loop, Settling& settling, const Segment& target,
                      const Specimen& specimen) const {
    const double load_band_Nm = load_torque_Nm(specimen, spec_.settling.load_tolerance_pct);
    return loop.run_until(
        [&](const BenchValues& values) {
          settling.add(values.angle_s, values.angle_rad, values.torque_Nm);
          // A brake that does not say what it holds is judged by the input torque alone.
          const double off_Nm = std::abs(values.brake.torque_Nm - target.output_torque_Nm);
          return settling.settled() && !(off_Nm > load_band_Nm);
        },
        spec_.settling.timeout_s);
  }

  MatrixSpec spec_;
  std::vector<hal::PlannedPoint> points_;
};

SettlingRule parse_settling(hal::ConfigReader& matrix) {
  SettlingRule rule;
  auto json = matrix.optional_object("settling");
  if (!json) return rule;
  rule.speed_tolerance_pct =
      json->number("speed_tolerance_pct", {0.1, 50}, rule.speed_tolerance_pct);
  rule.load_tolerance_pct = json->number("load_tolerance_pct", {0.1, 100}, rule.load_tolerance_pct);
  rule.speed_band_pct = json->number("speed_band_pct", {0.01, 50}, rule.speed_band_pct);
  rule.torque_band_pct = json->number("torque_band_pct", {0, 100}, rule.torque_band_pct);
  rule.torque_band_Nm = json->number("torque_band_Nm", {0, 100}, rule.torque_band_Nm);
  rule.hold_s = json->number("hold_s", {0.5, 600}, rule.hold_s);
  rule.timeout_s = json->number("timeout_s", {1, 3600}, rule.timeout_s);
  if (rule.timeout_s <= rule.hold_s) json->fault("timeout_s", "must be above hold_s");
  return rule;
}

}  // namespace

std::unique_ptr<Phase> parse_matrix(hal::ConfigReader& json) {
  MatrixSpec spec;
  spec.speeds_rpm = json.numbers("speeds_rpm", {1, 10000});
  spec.loads_pct = json.numbers("loads_pct", {0, 300});
  spec.repeats = json.integer("repeats", {1, 1000}, 1);
  spec.order = json.choice("order", {"nested", "randomised"}, "nested");
  if (spec.order == "randomised") spec.seed = json.integer("seed", {0, 2147483647});
  spec.settling = parse_settling(json);
  // Less than 4 turns cannot part the lines k/121 of the input speed from each other.
  spec.output_turns = json.object("record").number("output_turns", {4, 1000});
  const double count =
      double(spec.speeds_rpm.size()) * double(spec.loads_pct.size()) * spec.repeats;
  if (count > most_points) {
    json.fault("", fmt::format("{:.0f} points are more than {:.0f}", count, most_points));
    spec.repeats = 0;
  }
  return std::make_unique<Matrix>(std::move(spec));
}

}  // namespace rvbench::sequences
