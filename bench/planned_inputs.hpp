#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/campaign.hpp"
#include "hal/types/recording.hpp"
#include "sequences/plan.hpp"
#include "sim/plant_spec.hpp"

namespace rvbench::bench {

/// What drives a plant along a recording.
struct DrivenBy {
  std::vector<Channel> channels;
  Eigen::Index lead_in = 0;  ///< samples at their start that come before the recording's first
};

/// A point of a run holds no channel of what drove it: its plan says that. Constant inputs at the
/// clock of input_torque, for a plant with an induction_motor: "supply" is the planned speed
/// without slip, "brake_torque" the load. The record begins in steady motion, so they begin two
/// seconds earlier: from rest the shipped bench comes to within 1e-6 of it in that time.
/// @param rated_output_torque_Nm  what 100 % load means
/// @return nothing if a plan or the torque is not known, or the plant has no such inputs
std::optional<DrivenBy> planned_inputs(const sim::PlantSpec& plant, const Recording& point,
                                       double rated_output_torque_Nm);

/// What 100 % load meant by plan.json beside a recording; 167 N·m without one.
double rated_torque_beside_Nm(const std::filesystem::path& file);

/// planned_inputs(); if the recording holds an input of the plant, its own channels, and of the
/// planned ones those that it lacks, without a lead-in.
DrivenBy what_drove(const sim::PlantSpec& plant, const Recording& recording,
                    double rated_output_torque_Nm);

/// The points that a plan will record, in their order and long enough for its turns at a slip of
/// 9 %, with nothing measured yet: an input_torque of zeros.
std::vector<Recording> points_of(const sequences::TestPlan& plan, double rate_Hz);

/// Names of the channels that drive a plant or that it shows.
std::vector<std::string> channels_of(const sim::PlantSpec& plant);

/// Puts what drove each record of a run among its channels, as what_drove() has it. What was
/// recorded while the plant comes into step becomes lead-in.
void add_planned_inputs(const sim::PlantSpec& plant, Campaign& campaign);

}  // namespace rvbench::bench
