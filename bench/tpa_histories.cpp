#include "bench/tpa_histories.hpp"

#include <algorithm>
#include <utility>

#include "analysis/frf/signed_axis.hpp"
#include "bench/simulated_recording.hpp"
#include "hal/formats/read_recordings.hpp"

namespace rvbench::bench {
namespace {

using Eigen::Index;

constexpr Index most_stretches = 120;

const Channel* channel_at(const Recording& recording, const DegreeOfFreedom& place) {
  for (const Channel& channel : recording.channels) {
    if (analysis::same_axis({channel.info.name, channel.info.direction}, place) != 0) {
      return &channel;
    }
  }
  return nullptr;
}

Eigen::MatrixXd samples_at(const Recording& recording, const std::vector<DegreeOfFreedom>& places) {
  Eigen::MatrixXd samples(channel_at(recording, places.front())->samples.size(),
                          Index(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Channel& channel = *channel_at(recording, places[i]);
    const double sense =
        analysis::same_axis({channel.info.name, channel.info.direction}, places[i]);
    samples.col(Index(i)) = sense * channel.samples;
  }
  return samples;
}

}  // namespace

std::optional<analysis::PathHistories> histories_of(
    const analysis::PathContributions& contributions, const Recording& recording) {
  const Channel& first = *channel_at(recording, contributions.inputs.front());
  return analysis::path_histories(contributions, samples_at(recording, contributions.inputs),
                                  first.rate_Hz);
}

std::optional<ContributionsOverTime> contributions_over_time(
    const analysis::PathContributions& contributions, const Recording& recording) {
  const auto histories = histories_of(contributions, recording);
  if (!histories) return std::nullopt;
  const Index samples = histories->forces.rows();
  ContributionsOverTime over_time{double(samples) / histories->rate_Hz,
                                  histories->reach_back_s,
                                  histories->reach_ahead_s,
                                  histories->cut_share,
                                  {}};
  for (const Eigen::MatrixXd& at_target : histories->contributions) {
    over_time.rms.push_back(analysis::rms_over_time(at_target, std::min(most_stretches, samples)));
  }
  return over_time;
}

Status write_histories(const std::filesystem::path& file,
                       const analysis::PathContributions& contributions,
                       const std::string& recording, const HistoryLabels& labels) {
  auto read = hal::read_recordings(recording);
  if (!read) return read.error();
  const Recording& motion = read.value().front();
  const auto histories = histories_of(contributions, motion);
  if (!histories) {
    return IoError{IoErrc::refused, recording + ": sample rate and lines allow for no filters"};
  }
  const double start_s = channel_at(motion, contributions.inputs.front())->start_s;
  Recording written;
  const auto add = [&](std::string name, const std::string& unit, const std::string& direction,
                       Eigen::VectorXd samples) {
    written.channels.push_back(
        {{std::move(name), unit, direction}, histories->rate_Hz, start_s, std::move(samples)});
  };
  for (std::size_t path = 0; path < contributions.paths.size(); ++path) {
    const DegreeOfFreedom& place = contributions.paths[path];
    add(labels.input + place.point, labels.input_unit, place.direction,
        histories->forces.col(Index(path)));
  }
  for (std::size_t target = 0; target < contributions.targets.size(); ++target) {
    const DegreeOfFreedom& at = contributions.targets[target];
    for (std::size_t path = 0; path < contributions.paths.size(); ++path) {
      add(at.point + " by " + analysis::name_of(contributions.paths[path]), labels.target_unit,
          at.direction, histories->contributions[target].col(Index(path)));
    }
  }
  return write_vibration_hdf5(file, {std::move(written)});
}

}  // namespace rvbench::bench
