#include "analysis/tpa/path_histories.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "analysis/tpa/deconvolution_filters.hpp"
#include "analysis/tpa/filter_grid.hpp"
#include "analysis/tpa/mimo_convolver.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;
constexpr Index fewest_lines = 8, edge_lines = 10;
constexpr Index taps_per_delay = 4;

FilterDesign design_of(const LineGrid& grid, double rate_Hz) {
  FilterDesign design;
  design.rate_Hz = rate_Hz;
  design.taps = Index(std::lround(rate_Hz / grid.step_Hz));
  design.delay_samples = design.taps / taps_per_delay;
  design.from_Hz = grid.first_Hz;
  design.to_Hz = grid.frequency_Hz(grid.lines - 1);
  design.edge_Hz = grid.step_Hz * double(std::min(edge_lines, (grid.lines - 1) / 2));
  return design;
}

// The filters' answer, as late as the inputs.
Eigen::MatrixXd filtered(const FirMatrix& filters, const Eigen::Ref<const Eigen::MatrixXd>& in) {
  const Index delay = Index(filters.delay_samples), partition = filters.taps.rows();
  MimoConvolver convolver(filters, {partition, 1});
  const Index passes = (in.rows() + delay + partition - 1) / partition;
  Eigen::MatrixXd out(passes * partition, filters.outputs);
  const Index ready = convolver.push(in, out);
  const Index rest = passes * partition - in.rows();
  convolver.push(Eigen::MatrixXd::Zero(rest, in.cols()), out.bottomRows(out.rows() - ready));
  return out.middleRows(delay, in.rows());
}

// FRFs from one path to all targets.
LineMatrices column_of(const LineMatrices& all, Index column) {
  LineMatrices one = LineMatrices::unset(all.rows, 1, all.lines);
  for (Index line = 0; line < all.lines; ++line) one[line] = all[line].col(column);
  return one;
}

}  // namespace

std::optional<PathHistories> path_histories(const PathContributions& contributions,
                                            const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                            double rate_Hz) {
  constexpr Require require{"path_histories"};
  const LineGrid& grid = contributions.grid;
  require(
      inputs.cols() == Index(contributions.inputs.size()),
      std::to_string(inputs.cols()) + " inputs for " + std::to_string(contributions.inputs.size()));
  if (grid.lines < fewest_lines || !has_filter_grid(grid.first_Hz, grid.step_Hz, rate_Hz)) {
    return std::nullopt;
  }
  const FilterDesign design = design_of(grid, rate_Hz);
  PathHistories histories;
  const auto filters_of = [&](const LineMatrices& lines) {
    DesignedFilters designed = deconvolution_filters(lines, grid.first_Hz, grid.step_Hz, design);
    histories.cut_share = std::max(histories.cut_share, designed.cut_share.maxCoeff());
    return std::move(designed.filters);
  };
  histories.rate_Hz = rate_Hz;
  histories.reach_back_s = 2 * double(design.taps - design.delay_samples) / rate_Hz;
  histories.reach_ahead_s = 2 * double(design.delay_samples) / rate_Hz;
  histories.forces = filtered(filters_of(contributions.to_forces), inputs);
  histories.contributions.assign(contributions.targets.size(),
                                 Eigen::MatrixXd(inputs.rows(), contributions.forces.rows));
  for (Index path = 0; path < contributions.forces.rows; ++path) {
    const Eigen::MatrixXd at_targets = filtered(
        filters_of(column_of(contributions.target_frfs, path)), histories.forces.col(path));
    for (std::size_t target = 0; target < contributions.targets.size(); ++target) {
      histories.contributions[target].col(path) = at_targets.col(Index(target));
    }
  }
  return histories;
}

Eigen::MatrixXd rms_over_time(const Eigen::MatrixXd& samples, Index stretches) {
  constexpr Require require_stretches{"rms_over_time"};
  require_stretches(stretches >= 1 && stretches <= samples.rows(), "stretches without samples");
  Eigen::MatrixXd rms(samples.cols(), stretches);
  for (Index i = 0; i < stretches; ++i) {
    const Index from = i * samples.rows() / stretches, to = (i + 1) * samples.rows() / stretches;
    rms.col(i) =
        (samples.middleRows(from, to - from).cwiseAbs2().colwise().sum() / double(to - from))
            .cwiseSqrt()
            .transpose();
  }
  return rms;
}

}  // namespace rvbench::analysis
