#include "sim/robot/steady_response.hpp"

#include <algorithm>

#include "hal/types/parallel_for.hpp"
#include "hal/types/units.hpp"
#include "sim/real_transform.hpp"

namespace rvbench::sim {
namespace {

// Calls body(first, gains) for so many lines at once that what the modes hold stays in the cache;
// gains: lines x modes.
template <class Body>
void for_blocks(const Modes& modes, const PeriodGrid& grid, Eigen::Index first, Eigen::Index count,
                const Body& body) {
  constexpr Eigen::Index at_once = 1024;
  for (Eigen::Index at = first; at < first + count; at += at_once) {
    const Eigen::Index lines = std::min(at_once, first + count - at);
    Eigen::VectorXcd s = Eigen::VectorXcd::Zero(lines);
    s.imag() = Eigen::VectorXd::LinSpaced(lines, double(at), double(at + lines - 1)) *
               (units::two_pi * grid.step_Hz);
    body(at, modal_accelerance(modes, s));
  }
}

}  // namespace

Eigen::MatrixXcd steady_response(const Modes& modes, const PeriodGrid& grid,
                                 const Eigen::MatrixXcd& forces_N, const Eigen::MatrixXd& at_forces,
                                 const Eigen::MatrixXd& at_points) {
  Eigen::MatrixXcd response(grid.lines, at_points.rows());
  for_blocks(modes, grid, 0, grid.lines, [&](Eigen::Index at, const Eigen::MatrixXcd& gains) {
    Eigen::MatrixXcd modal = forces_N.middleRows(at, gains.rows()) * at_forces;
    modal = modal.cwiseProduct(gains);
    response.middleRows(at, gains.rows()) = modal * at_points.transpose();
  });
  return response;
}

Eigen::MatrixXcd pair_accelerance(const Modes& modes, const PeriodGrid& grid, Eigen::Index first,
                                  Eigen::Index count, const Eigen::MatrixXd& shape_products) {
  Eigen::MatrixXcd response(count, shape_products.rows());
  for_blocks(modes, grid, first, count, [&](Eigen::Index at, const Eigen::MatrixXcd& gains) {
    response.middleRows(at - first, gains.rows()) = gains * shape_products.transpose();
  });
  return response;
}

Eigen::MatrixXd samples_of(const PeriodGrid& grid, const Eigen::MatrixXcd& lines,
                           Eigen::Index count, unsigned threads) {
  Eigen::MatrixXd samples(count, lines.cols());
  const auto one = [&](std::size_t signal) {
    const auto column = static_cast<Eigen::Index>(signal);
    Eigen::VectorXcd spectrum = Eigen::VectorXcd::Zero(grid.samples / 2 + 1);
    spectrum.head(lines.rows()) = lines.col(column) * (0.5 * static_cast<double>(grid.samples));
    spectrum[0] = 0;
    Eigen::VectorXd period(grid.samples);
    samples_from_lines(period.data(), spectrum.data(), grid.samples);
    samples.col(column) = period.head(count);
  };
  parallel_for(static_cast<std::size_t>(lines.cols()), one, threads);
  return samples;
}

}  // namespace rvbench::sim
