#include "bench/planned_inputs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "bench/campaign_points.hpp"
#include "bench/simulated_recording.hpp"
#include "hal/types/units.hpp"
#include "sequences/plan.hpp"
#include "sim/rv_plant.hpp"

namespace rvbench::bench {
namespace {

constexpr double lead_in_s = 2;
constexpr double rated_rv20e_Nm = 167;
constexpr double for_slip = 1.1;  // of the planned time: a run records until its turns are made

const sim::TermSpec* motor_of(const sim::PlantSpec& plant) {
  const auto motor = std::ranges::find(plant.terms, "induction_motor", &sim::TermSpec::type);
  return motor == plant.terms.end() ? nullptr : &*motor;
}

}  // namespace

std::optional<DrivenBy> planned_inputs(const sim::PlantSpec& plant, const Recording& point,
                                       double rated_output_torque_Nm) {
  const Channel* clock = point.find(channel_names::input_torque);
  const sim::TermSpec* motor = motor_of(plant);
  if (clock == nullptr || motor == nullptr || !is_point(point) ||
      plant.find_input(sim::rv_parts::supply) == nullptr ||
      plant.find_input(sim::rv_parts::brake_torque) == nullptr) {
    return std::nullopt;
  }
  DrivenBy driven;
  driven.lead_in = std::lround(lead_in_s * clock->rate_Hz);
  const auto add = [&](std::string_view name, double value) {
    const sim::InputSpec& input = *plant.find_input(name);
    const auto lead_in = static_cast<double>(driven.lead_in);
    driven.channels.push_back(
        {{input.channel, input.unit, "", not_known},
         clock->rate_Hz,
         clock->start_s - lead_in / clock->rate_Hz,
         Eigen::VectorXd::Constant(clock->samples.size() + driven.lead_in, value)});
  };
  const double pole_pairs = motor->parameters.at("pole_pairs").value;
  add(sim::rv_parts::supply, units::Hz_from_rpm(point.planned_speed_rpm) * pole_pairs);
  add(sim::rv_parts::brake_torque, point.load_pct / 100 * rated_output_torque_Nm);
  return driven;
}

double rated_torque_beside_Nm(const std::filesystem::path& file) {
  const std::filesystem::path plan_file = file.parent_path() / "plan.json";
  if (!std::filesystem::exists(plan_file)) return rated_rv20e_Nm;
  const auto plan = sequences::read_plan(plan_file.string());
  return plan.index() == 0 ? std::get<0>(plan).specimen.rated_output_torque_Nm : rated_rv20e_Nm;
}

DrivenBy what_drove(const sim::PlantSpec& plant, const Recording& recording,
                    double rated_output_torque_Nm) {
  auto planned = planned_inputs(plant, recording, rated_output_torque_Nm);
  if (!planned) return {recording.channels};
  const bool recorded = std::ranges::any_of(plant.inputs, [&](const sim::InputSpec& input) {
    return recording.find(input.channel) != nullptr;
  });
  if (!recorded) return *std::move(planned);
  DrivenBy driven{recording.channels};
  for (Channel& channel : planned->channels) {
    if (recording.find(channel.info.name) != nullptr) continue;
    drop_lead_in(channel, planned->lead_in);
    driven.channels.push_back(std::move(channel));
  }
  return driven;
}

std::vector<Recording> points_of(const sequences::TestPlan& plan, double rate_Hz) {
  std::vector<Recording> points;
  for (const auto& phase : plan.main) {
    const std::vector<hal::PlannedPoint> planned = phase->points();
    auto point = planned.begin();
    for (const sequences::Segment& segment : phase->timeline(plan.specimen)) {
      if (!segment.recorded || point == planned.end()) continue;
      Recording recording;
      recording.source = plan.name;
      recording.status = "ok";
      recording.planned_speed_rpm = point->speed_rpm;
      recording.load_pct = point->load_pct;
      recording.repeat = point->repeat;
      const auto samples =
          static_cast<Eigen::Index>(std::lround(for_slip * segment.duration_s * rate_Hz));
      recording.channels.push_back({{std::string(channel_names::input_torque), "", "", not_known},
                                    rate_Hz,
                                    0,
                                    Eigen::VectorXd::Zero(samples)});
      points.push_back(std::move(recording));
      ++point;
    }
  }
  return points;
}

std::vector<std::string> channels_of(const sim::PlantSpec& plant) {
  std::vector<std::string> names;
  for (const sim::InputSpec& input : plant.inputs) names.push_back(input.channel);
  for (const sim::OutputSpec& output : plant.outputs) names.push_back(output.channel);
  return names;
}

void add_planned_inputs(const sim::PlantSpec& plant, Campaign& campaign) {
  std::map<std::filesystem::path, double> rated_Nm;  // by the folder of the recording
  for (CampaignRecord& record : campaign.records) {
    if (!is_point(record.recording)) continue;
    const std::filesystem::path source = record.recording.source;
    const auto [rated, is_new] = rated_Nm.try_emplace(source.parent_path(), 0);
    if (is_new) rated->second = rated_torque_beside_Nm(source);
    DrivenBy driven = what_drove(plant, record.recording, rated->second);
    record.lead_in = std::max(record.lead_in, driven.lead_in);
    for (Channel& channel : driven.channels) {
      if (record.recording.find(channel.info.name) != nullptr) continue;
      drop_lead_in(channel, driven.lead_in);
      // To the last digit: in step with what was recorded.
      channel.start_s = record.recording.find(channel_names::input_torque)->start_s;
      record.recording.channels.push_back(std::move(channel));
    }
  }
}

}  // namespace rvbench::bench
