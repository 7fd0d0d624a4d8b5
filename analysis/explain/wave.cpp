#include "analysis/explain/wave.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::analysis {
namespace {

constexpr double next_to_nothing = 0.3;  // of the mark of a size that grows as far as a phase turns

constexpr double part_of_wave = 0.01;

}  // namespace

std::vector<std::size_t> waves_among(const ForwardModel& model,
                                     const std::vector<std::size_t>& effects) {
  std::vector<std::size_t> waves;
  std::size_t at = model.base().size();
  for (const std::size_t effect : effects) {
    const Candidate& candidate = model.library()[effect];
    if (candidate.phasor) waves.push_back(at);
    at += candidate.parameters.size();
  }
  return waves;
}

std::vector<double> as_waves(std::vector<double> values, const std::vector<std::size_t>& waves) {
  for (const std::size_t at : waves) {
    const double cosine = values[at], sine = values[at + 1];
    values[at] = std::hypot(cosine, sine);
    values[at + 1] = std::atan2(sine, cosine);
  }
  return values;
}

std::vector<double> from_waves(std::vector<double> values, const std::vector<std::size_t>& waves) {
  for (const std::size_t at : waves) {
    const double size = values[at], phase_rad = values[at + 1];
    values[at] = size * std::cos(phase_rad);
    values[at + 1] = size * std::sin(phase_rad);
  }
  return values;
}

double step_of_wave(double usual, double size) {
  return size > 0 ? std::min(usual, part_of_wave * size) : usual;
}

Eigen::MatrixXd slopes_of_waves(Eigen::MatrixXd slopes, const std::vector<double>& values,
                                const std::vector<std::size_t>& waves) {
  for (const std::size_t at : waves) {
    auto cosine = slopes.col(Eigen::Index(at)), sine = slopes.col(Eigen::Index(at) + 1);
    const double size = std::hypot(values[at], values[at + 1]);
    const double c = size > 0 ? values[at] / size : 1, s = size > 0 ? values[at + 1] / size : 0;
    const Eigen::VectorXd turned = size * (c * sine - s * cosine);
    cosine = c * cosine + s * sine;
    sine = turned;
  }
  return slopes;
}

std::vector<std::size_t> waves_that_turn(const Eigen::MatrixXd& slopes,
                                         const std::vector<double>& values,
                                         const std::vector<std::size_t>& waves) {
  const Eigen::MatrixXd of_waves = slopes_of_waves(slopes, values, waves);
  std::vector<std::size_t> turning;
  for (const std::size_t at : waves) {
    const double size = std::hypot(values[at], values[at + 1]);
    const double by_size = size * of_waves.col(Eigen::Index(at)).norm();
    if (of_waves.col(Eigen::Index(at) + 1).norm() < next_to_nothing * by_size)
      turning.push_back(at);
  }
  return turning;
}

}  // namespace rvbench::analysis
