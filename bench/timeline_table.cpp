#include "bench/timeline_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/console.hpp"
#include "bench/json_text.hpp"
#include "hal/json_object.hpp"
#include "hal/types/units.hpp"
#include "sequences/timeline.hpp"

namespace rvbench::bench {
namespace {

using sequences::Segment;
using sequences::TestPlan;

double input_torque_Nm(const Segment& segment, const TestPlan& plan) {
  return segment.output_torque_Nm / plan.specimen.gear_ratio;
}

double input_power_W(const Segment& segment, const TestPlan& plan) {
  return std::abs(input_torque_Nm(segment, plan) * units::rad_s_from_rpm(segment.speed_rpm));
}

struct Envelope {
  double total_s = 0;
  double recorded_s = 0;
  double max_speed_rpm = 0;
  double max_output_torque_Nm = 0;
  double max_input_torque_Nm = 0;
  double max_input_power_W = 0;
};

Envelope envelope_of(const std::vector<Segment>& segments, const TestPlan& plan) {
  Envelope most;
  for (const Segment& segment : segments) {
    most.total_s += segment.duration_s;
    if (segment.recorded) most.recorded_s += segment.duration_s;
    most.max_speed_rpm = std::max(most.max_speed_rpm, std::abs(segment.speed_rpm));
    most.max_output_torque_Nm =
        std::max(most.max_output_torque_Nm, std::abs(segment.output_torque_Nm));
    most.max_input_torque_Nm =
        std::max(most.max_input_torque_Nm, std::abs(input_torque_Nm(segment, plan)));
    most.max_input_power_W = std::max(most.max_input_power_W, input_power_W(segment, plan));
  }
  return most;
}

std::string clock_text(double seconds) {
  const long whole = std::lround(seconds);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

std::string timeline_table(const TestPlan& plan) {
  const std::vector<Segment> segments = sequences::timeline(plan);
  int width = 4;
  for (const Segment& segment : segments) width = std::max(width, shown_width(segment.what));
  std::string text = fmt::format("Plan {}: {}\n\n", plan.name, plan.description);
  text += "   start  length s  " + padded("what", width) +
          "  speed rpm  output N·m  input N·m  input W\n";
  double start_s = 0;
  for (const Segment& segment : segments) {
    text += fmt::format("{:>8}  {:8.1f}  {}  {:9.0f}  {:10.1f}  {:9.3f}  {:7.1f}\n",
                        clock_text(start_s), segment.duration_s, padded(segment.what, width),
                        segment.speed_rpm, segment.output_torque_Nm, input_torque_Nm(segment, plan),
                        input_power_W(segment, plan));
    start_s += segment.duration_s;
  }
  const Envelope most = envelope_of(segments, plan);
  return text +
         fmt::format(
             "\nTotal {} ({:.0f} s), of which {:.0f} s recorded in {} points\n"
             "At most {:.0f} rpm; {:.1f} N·m at the output, {:.3f} N·m and {:.1f} W at the input\n",
             clock_text(most.total_s), most.total_s, most.recorded_s, plan.points().size(),
             most.max_speed_rpm, most.max_output_torque_Nm, most.max_input_torque_Nm,
             most.max_input_power_W);
}

std::string timeline_json(const TestPlan& plan) {
  const std::vector<Segment> segments = sequences::timeline(plan);
  const Envelope most = envelope_of(segments, plan);
  nlohmann::ordered_json json =
      hal::json_object({{"plan", plan.name},
                        {"total_s", most.total_s},
                        {"recorded_s", most.recorded_s},
                        {"points", plan.points().size()},
                        {"max_speed_rpm", most.max_speed_rpm},
                        {"max_output_torque_Nm", most.max_output_torque_Nm},
                        {"max_input_torque_Nm", most.max_input_torque_Nm},
                        {"max_input_power_W", most.max_input_power_W},
                        {"timeline", nlohmann::ordered_json::array()}});
  for (const Segment& segment : segments) {
    json["timeline"].push_back(
        hal::json_object({{"what", segment.what},
                          {"duration_s", segment.duration_s},
                          {"speed_rpm", segment.speed_rpm},
                          {"output_torque_Nm", segment.output_torque_Nm},
                          {"input_torque_Nm", input_torque_Nm(segment, plan)},
                          {"input_power_W", input_power_W(segment, plan)},
                          {"recorded", segment.recorded}}));
  }
  return json_text(json);
}

}  // namespace rvbench::bench
