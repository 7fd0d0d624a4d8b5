#pragma once

#include <utility>
#include <vector>

#include "analysis/frf/hammer_test.hpp"
#include "analysis/tpa/hammer_alignment.hpp"
#include "analysis/tpa/matrix_inverse.hpp"
#include "analysis/tpa/mimo_convolver.hpp"
#include "analysis/tpa/smoothed_frfs.hpp"
#include "sim/robot/hammer_test.hpp"
#include "sim/robot/operation.hpp"

namespace rvbench::test {

/// Places of the virtual robot's sensors by what they are for.
inline analysis::SensorRoles robot_roles(const sim::VirtualRobot& robot) {
  const auto& all = robot.sensor_places();
  const auto from = [&](Eigen::Index first) { return all.begin() + first; };
  return {{all.begin(), from(sim::VirtualRobot::first_target)},
          {from(sim::VirtualRobot::first_target), from(sim::VirtualRobot::first_validation)},
          {from(sim::VirtualRobot::first_validation), all.end()}};
}

/// Hits as whoever records them has them: nothing says which are bad.
inline std::vector<analysis::HammerSeries> hammer_series(std::vector<Recording> hits,
                                                         const sim::RobotOptions& options) {
  std::vector<analysis::HammerSeries> session;
  for (Recording& hit : hits) {
    const Eigen::Index samples = hit.channels[0].samples.size();
    analysis::FrfRecord record{hit.source, options.rate_Hz, hit.channels[0].samples,
                               Eigen::MatrixXd(samples, sim::VirtualRobot::sensors)};
    analysis::FrfSetup setup;
    for (std::size_t i = 0; i < hit.channels.size(); ++i) {
      const ChannelInfo& info = hit.channels[i].info;
      const DegreeOfFreedom place{info.name, info.direction};
      if (i == 0) {
        setup.excitations.push_back({place, info.unit, options.force_range_N});
      } else {
        setup.responses.push_back({place, info.unit, options.acceleration_range_m_s2});
        record.responses.col(Eigen::Index(i) - 1) = hit.channels[i].samples;
      }
    }
    if (hit.repeat == 1) session.push_back({std::move(setup), {}});
    session.back().hits.push_back(std::move(record));
    hit.channels.clear();
  }
  return session;
}

/// FRFs of the simulated hammer test as they were estimated, on the lines of the grid; its step is
/// 1 / hit_s.
inline analysis::FrfMatrix measured_frfs(const sim::VirtualRobot& robot,
                                         const analysis::LineGrid& grid) {
  const auto results =
      analysis::measure_session(hammer_series(sim::hammer_test(robot).hits, robot.options()), {});
  const auto first = Eigen::Index(std::lround(grid.first_Hz / grid.step_Hz));
  std::vector<FrequencyResponse> set;
  for (const analysis::HammerResult& result : results) {
    for (const analysis::EstimatedResponse& estimate : result.estimates.responses) {
      FrequencyResponse& frf = set.emplace_back(estimate.response);
      frf.first_Hz = grid.first_Hz;
      frf.values = estimate.response.values.segment(first, grid.lines);
      if (frf.coherence.size() > 0) {
        frf.coherence = estimate.response.coherence.segment(first, grid.lines);
      }
    }
  }
  return analysis::assemble_frf_matrix(set).matrix.value();
}

/// FRFs as the command works with them.
inline analysis::FrfMatrix prepared(const analysis::FrfMatrix& measured) {
  analysis::FrfMatrix smooth = analysis::smooth_frfs(measured).frfs;
  const analysis::HammerAlignment alignment = analysis::hammer_alignment(smooth);
  return analysis::aligned_frfs(std::move(smooth), alignment);
}

inline analysis::FrfMatrix exact_frfs(const sim::VirtualRobot& robot,
                                      const analysis::LineGrid& grid) {
  return analysis::assemble_frf_matrix(
             robot.frequency_responses(grid.first_Hz, grid.step_Hz, grid.lines))
      .matrix.value();
}

inline analysis::OperatingSpectra spectra_of(const sim::VirtualRobot& robot,
                                             const Recording& recording,
                                             const analysis::LineGrid& grid) {
  return analysis::operating_spectra(recording, robot.sensor_places(), grid).spectra.value();
}

/// Hann spectra of histories, samples x channels.
inline analysis::LineMatrices spectra_of(const Eigen::MatrixXd& histories, double rate_Hz,
                                         const analysis::LineGrid& grid) {
  Recording recording;
  std::vector<DegreeOfFreedom> places;
  for (Eigen::Index i = 0; i < histories.cols(); ++i) {
    places.push_back({std::to_string(i), "+X"});
    recording.channels.push_back({{std::to_string(i), "", "+X"}, rate_Hz, 0, histories.col(i)});
  }
  return analysis::operating_spectra(recording, places, grid).spectra.value().values;
}

/// What a recording holds at these places: samples x places.
inline Eigen::MatrixXd samples_of(const Recording& recording,
                                  const std::vector<DegreeOfFreedom>& places) {
  Eigen::MatrixXd samples(recording.channels.front().samples.size(), Eigen::Index(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const Channel& channel : recording.channels) {
      if (DegreeOfFreedom{channel.info.name, channel.info.direction} != places[i]) continue;
      samples.col(Eigen::Index(i)) = channel.samples;
    }
  }
  return samples;
}

/// What filters make of inputs, their delay taken out, as far as the record goes.
inline Eigen::MatrixXd filtered(const analysis::FirMatrix& filters, const Eigen::MatrixXd& inputs) {
  const auto delay = static_cast<Eigen::Index>(std::floor(filters.delay_samples));
  const Eigen::Index taps = filters.taps.rows();
  analysis::MimoConvolver convolver(filters, {taps, 1});
  Eigen::MatrixXd padded = Eigen::MatrixXd::Zero(inputs.rows() + 2 * taps, inputs.cols());
  padded.topRows(inputs.rows()) = inputs;
  Eigen::MatrixXd out(convolver.ready_after(padded.rows()), filters.outputs);
  convolver.push(padded, out);
  return out.middleRows(delay, inputs.rows());
}

}  // namespace rvbench::test
