#include "bench/channel_fault.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/quality.hpp"
#include "analysis/statistics.hpp"
#include "hal/did_you_mean.hpp"

namespace rvbench::bench {
namespace {

constexpr double beyond_sensors = 1e30;
constexpr double far_off = 100;  // times all but a few
constexpr std::size_t few = 3;
constexpr std::size_t one_in = 1000;
constexpr std::size_t most_names = 12;

// "time, force, speed and 9 more"
std::string names_of(const Recording& recording) {
  std::string names;
  const std::size_t shown = std::min(recording.channels.size(), most_names);
  for (std::size_t i = 0; i < shown; ++i) {
    names += (i > 0 ? ", " : "") + hal::in_quotes(recording.channels[i].info.name);
  }
  const std::size_t left = recording.channels.size() - shown;
  return left > 0 ? fmt::format("{} and {} more", names, left) : names;
}

}  // namespace

std::string channel_misfit(const Recording& recording, const sim::OutputSpec& output) {
  const std::string name = hal::in_quotes(output.channel);
  const Channel* channel = recording.find(output.channel);
  if (channel == nullptr) {
    return name + " is no channel of the recording, which has " + names_of(recording);
  }
  if (!channel->info.unit.empty() && channel->info.unit != output.unit) {
    return fmt::format("{} is in {}, the plant shows {}", name, channel->info.unit, output.unit);
  }
  if (!channel->samples.allFinite()) return name + " has samples that are not finite";
  return {};
}

std::string quality_fault(const Channel& channel) {
  for (const analysis::QualityNote& note : analysis::channel_quality(channel, not_known)) {
    if (note.invalidates) return hal::in_quotes(channel.info.name) + " is " + note.what;
  }
  return {};
}

std::string channel_fault(const Recording& recording, const sim::OutputSpec& output) {
  const std::string misfit = channel_misfit(recording, output);
  return misfit.empty() ? quality_fault(*recording.find(output.channel)) : misfit;
}

std::string sample_fault(const Channel& channel) {
  const Eigen::VectorXd& x = channel.samples;
  if (x.size() <= Eigen::Index(one_in / 2) || !x.allFinite()) return {};
  const double middle = analysis::median(std::vector<double>(x.begin(), x.end()));
  std::vector<double> away;
  for (const double value : x) away.push_back(std::abs(value - middle));
  const auto farthest = std::ranges::max_element(away);
  const auto at = farthest - away.begin();
  const double largest = *farthest;
  const auto others = away.begin() + std::ptrdiff_t(std::max(few, away.size() / one_in));
  std::ranges::nth_element(away, others, std::ranges::greater{});
  const bool is_spike = *others > 0 && largest > far_off * *others;
  if (!is_spike && x.cwiseAbs().maxCoeff() < beyond_sensors) return {};
  return fmt::format("sample {} is {:.3g}, where all but a few are within {:.3g} of {:.3g}", at + 1,
                     x[at], *others, middle);
}

void note_clipped_inputs(const sim::PlantSpec& plant, Campaign& campaign) {
  for (const CampaignRecord& record : campaign.records) {
    for (const sim::InputSpec& input : plant.inputs) {
      const Channel* channel = record.recording.find(input.channel);
      if (input.kind != sim::InputKind::force || channel == nullptr) continue;
      const Eigen::VectorXd& x = channel->samples;
      if (!(x.maxCoeff() > x.minCoeff())) continue;  // constant, as a brake's torque is
      for (const analysis::QualityNote& note : analysis::channel_quality(*channel, not_known)) {
        if (!note.what.starts_with("clipped")) continue;
        campaign.notes.push_back(fmt::format("{}: {} looks {}, unless it was driven so",
                                             record.name, hal::in_quotes(input.channel),
                                             note.what));
      }
    }
  }
}

}  // namespace rvbench::bench
