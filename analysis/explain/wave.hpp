#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "analysis/explain/forward_model.hpp"

namespace rvbench::analysis {

/// Of the values of a model with some effects: where the two parts of each phasor begin.
/// Shape   one place per wave. Errors  none thrown. Source  definition
std::vector<std::size_t> waves_among(const ForwardModel& model,
                                     const std::vector<std::size_t>& effects);

/// The values, each wave as size and phase, rad, in place of its cosine and sine part.
/// Shape   of the values. Errors  none thrown. Source  plane trigonometry
std::vector<double> as_waves(std::vector<double> values, const std::vector<std::size_t>& waves);

/// The other way. Shape, errors, source  of as_waves()
std::vector<double> from_waves(std::vector<double> values, const std::vector<std::size_t>& waves);

/// A step of a wave's size or of its parts, to tell slopes by: the usual one, but a hundredth of
/// the wave's size at most, for what shows in amplitudes has a corner where there is no wave.
/// Units   of the size. Errors  none thrown. Source  ours
double step_of_wave(double usual, double size);

/// Slopes with respect to as_waves(values, waves), of slopes with respect to the values.
/// Shape, units  residuals by values; of a phase, per rad
/// Errors  none thrown. Source  the chain rule
Eigen::MatrixXd slopes_of_waves(Eigen::MatrixXd slopes, const std::vector<double>& values,
                                const std::vector<std::size_t>& waves);

/// Those of the waves whose phase leaves next to no trace beside what their size does: straight on,
/// a step that turns them would make them larger.
/// Shape   some of `waves`. Errors  none thrown. Source  ours
std::vector<std::size_t> waves_that_turn(const Eigen::MatrixXd& slopes,
                                         const std::vector<double>& values,
                                         const std::vector<std::size_t>& waves);

}  // namespace rvbench::analysis
