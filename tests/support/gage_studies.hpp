#pragma once

#include <random>

#include "analysis/station/gage_study.hpp"

namespace rvbench::test {

/// The worked example of AIAG, Measurement Systems Analysis, 4th ed. (2010), ch. III: 10 parts, 3
/// appraisers, 3 trials.
inline analysis::GageReadings aiag_study() {
  // Appraiser and trial by line, part by column.
  static constexpr double readings[9][10] = {
      {0.29, -0.56, 1.34, 0.47, -0.80, 0.02, 0.59, -0.31, 2.26, -1.36},
      {0.41, -0.68, 1.17, 0.50, -0.92, -0.11, 0.75, -0.20, 1.99, -1.25},
      {0.64, -0.58, 1.27, 0.64, -0.84, -0.21, 0.66, -0.17, 2.01, -1.31},
      {0.08, -0.47, 1.19, 0.01, -0.56, -0.20, 0.47, -0.63, 1.80, -1.68},
      {0.25, -1.22, 0.94, 1.03, -1.20, 0.22, 0.55, 0.08, 2.12, -1.62},
      {0.07, -0.68, 1.34, 0.20, -1.28, 0.06, 0.83, -0.34, 2.19, -1.50},
      {0.04, -1.38, 0.88, 0.14, -1.46, -0.29, 0.02, -0.46, 1.77, -1.49},
      {-0.11, -1.13, 1.09, 0.20, -1.07, -0.67, 0.01, -0.56, 1.45, -1.77},
      {-0.15, -0.96, 0.67, 0.11, -1.45, -0.49, 0.21, -0.49, 1.87, -2.16}};
  analysis::GageReadings study{10, 3, 3, {}};
  for (std::size_t part = 0; part < 10; ++part) {
    for (std::size_t row = 0; row < 9; ++row) study.values.push_back(readings[row][part]);
  }
  return study;
}

/// Standard deviations of a gage and of what it measures.
struct GageTruth {
  double parts = 1, operators = 0, interaction = 0, repeatability = 0.1;
};

inline analysis::GageReadings simulated_study(const GageTruth& truth, std::size_t parts,
                                              std::size_t operators, std::size_t trials,
                                              unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<double> of_operators(operators);
  for (double& effect : of_operators) effect = truth.operators * normal(engine);
  analysis::GageReadings study{parts, operators, trials, {}};
  for (std::size_t part = 0; part < parts; ++part) {
    const double of_part = truth.parts * normal(engine);
    for (const double of_operator : of_operators) {
      const double of_both = truth.interaction * normal(engine);
      for (std::size_t trial = 0; trial < trials; ++trial) {
        study.values.push_back(of_part + of_operator + of_both +
                               truth.repeatability * normal(engine));
      }
    }
  }
  return study;
}

}  // namespace rvbench::test
