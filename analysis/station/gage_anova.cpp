#include "analysis/station/gage_anova.hpp"

#include <Eigen/Core>

#include "analysis/station/distributions.hpp"

namespace rvbench::analysis {
namespace {

using Eigen::Index;

// Mean over the trials: parts x operators. By what they differ from the first, so that of readings
// that are all alike it is exactly theirs.
Eigen::ArrayXXd cell_means(const GageReadings& readings) {
  Eigen::ArrayXXd means(Index(readings.parts), Index(readings.operators));
  for (std::size_t part = 0; part < readings.parts; ++part) {
    for (std::size_t op = 0; op < readings.operators; ++op) {
      const double first = readings.at(part, op, 0);
      double off = 0;
      for (std::size_t trial = 1; trial < readings.trials; ++trial) {
        off += readings.at(part, op, trial) - first;
      }
      means(Index(part), Index(op)) = first + off / double(readings.trials);
    }
  }
  return means;
}

double squares_within_cells(const GageReadings& readings, const Eigen::ArrayXXd& means) {
  double sum = 0;
  for (std::size_t part = 0; part < readings.parts; ++part) {
    for (std::size_t op = 0; op < readings.operators; ++op) {
      for (std::size_t trial = 0; trial < readings.trials; ++trial) {
        const double off = readings.at(part, op, trial) - means(Index(part), Index(op));
        sum += off * off;
      }
    }
  }
  return sum;
}

void hold_against(const AnovaLine& error, AnovaLine& line) {
  if (!(error.sum_of_squares > 0)) return;
  line.f = line.mean_square() / error.mean_square();
  line.p_value = f_p_value(line.f, line.freedom, error.freedom);
}

}  // namespace

AnovaLine GageAnova::error() const {
  if (!is_pooled) return repeatability;
  return {interaction.sum_of_squares + repeatability.sum_of_squares,
          interaction.freedom + repeatability.freedom, 0, 1};
}

GageAnova anova_of(const GageReadings& readings) {
  const double p = double(readings.parts), o = double(readings.operators),
               r = double(readings.trials);
  const Eigen::ArrayXXd cells = cell_means(readings);
  const Eigen::ArrayXd of_parts = cells.rowwise().mean() - cells.mean();
  const Eigen::ArrayXd of_operators = cells.colwise().mean().transpose() - cells.mean();
  Eigen::ArrayXXd rest = cells - cells.mean();
  rest.colwise() -= of_parts;
  rest.rowwise() -= of_operators.transpose();

  GageAnova anova;
  anova.parts = {o * r * of_parts.square().sum(), p - 1, 0, 1};
  anova.operators = {p * r * of_operators.square().sum(), o - 1, 0, 1};
  anova.interaction = {r * rest.square().sum(), (p - 1) * (o - 1), 0, 1};
  anova.repeatability = {squares_within_cells(readings, cells), p * o * (r - 1), 0, 1};
  hold_against(anova.repeatability, anova.interaction);
  anova.is_pooled = anova.interaction.p_value > pooling_p;
  const AnovaLine error = anova.is_pooled ? anova.error() : anova.interaction;
  hold_against(error, anova.parts);
  hold_against(error, anova.operators);
  return anova;
}

}  // namespace rvbench::analysis
