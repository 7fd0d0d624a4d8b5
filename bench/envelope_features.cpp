#include "bench/envelope_features.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rvbench::bench {
namespace {

constexpr Eigen::Index solved_lines = 1200;  // 3 Hz of 3600: modes as narrow as 1 % at 300 Hz
constexpr double lines_told_apart = 2;       // half a Hann window's main lobe
constexpr double most_slip = 0.02;           // of rolling elements: their lines stray that far
constexpr double worth_comparing = 0.1;      // of the deepest swell that an effect brings
constexpr double least_power = 1e-30;        // of a band that holds nothing

}  // namespace

sim::FrequencyBand solved_band(const sim::OutputSpec& output) {
  const double step_Hz = (output.to_Hz - output.from_Hz) / double(solved_lines);
  return {output.from_Hz + step_Hz / 2, output.to_Hz - step_Hz / 4, step_Hz};
}

Eigen::VectorXd levels_dB(const Eigen::VectorXd& mean_square) {
  return 10 * mean_square.cwiseMax(least_power).array().log10();
}

Eigen::VectorXd mean_square_of(const sim::Vibration& vibration, const sim::FrequencyBand& band) {
  const Eigen::Index each = band.size() / level_parts;
  Eigen::VectorXd parts(level_parts);
  for (Eigen::Index p = 0; p < level_parts; ++p) {
    parts[p] = vibration.density.segment(p * each, each).sum() * band.step_Hz;
  }
  return parts;
}

double slip_width_Hz(double frequency_Hz) { return most_slip * frequency_Hz; }

double line_width_Hz(double frequency_Hz, double shaft_Hz) {
  return std::max(slip_width_Hz(frequency_Hz), lines_told_apart * shaft_Hz / turns_per_block);
}

double depth_of(const sim::Vibration& vibration, double frequency_Hz, double within_Hz) {
  double squares = 0;
  for (const sim::RandomForce::Swell& swell : vibration.swells) {
    if (std::abs(swell.frequency_Hz - frequency_Hz) <= within_Hz) {
      squares += swell.depth * swell.depth;
    }
  }
  return std::sqrt(squares);
}

std::vector<double> orders_of_swells(const std::vector<sim::Vibration>& shown, double shaft_Hz) {
  std::vector<double> orders;
  for (const sim::Vibration& vibration : shown) {
    double deepest = 0;
    for (const auto& swell : vibration.swells) deepest = std::max(deepest, std::abs(swell.depth));
    for (const auto& swell : vibration.swells) {
      if (swell.depth == 0 || std::abs(swell.depth) < worth_comparing * deepest) continue;
      const double order = swell.frequency_Hz / shaft_Hz;
      const bool known = std::ranges::any_of(orders, [&](double other) {
        return std::abs(order - other) <= line_width_Hz(std::max(order, other), 1);
      });
      if (!known) orders.push_back(order);
    }
  }
  std::ranges::sort(orders);
  return orders;
}

Eigen::VectorXd drawn_depth(const sim::Vibration& shown, const analysis::Spectrum& measured) {
  const Eigen::Index size = measured.amplitude.size();
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(size);
  for (Eigen::Index k = 1; k < size; ++k) {
    const auto near = analysis::depth_near(measured, measured.axis(k), measured.resolution);
    squares[k] = 2 * near.noise_sigma * near.noise_sigma;
  }
  for (const sim::RandomForce::Swell& swell : shown.swells) {
    const auto at = std::lround(swell.frequency_Hz / measured.resolution);
    const auto reach =
        std::lround(line_width_Hz(swell.frequency_Hz, turns_per_block * measured.resolution) /
                    measured.resolution);
    if (at - reach < 1 || at + reach + 1 >= size) continue;
    Eigen::Index highest = 0;
    measured.amplitude.segment(at - reach, 2 * reach + 1).maxCoeff(&highest);
    highest += at - reach;
    for (const auto& [line, part] :
         {std::pair(highest - 1, 0.5), {highest, 1.0}, {highest + 1, 0.5}}) {
      squares[line] += std::pow(part * swell.depth, 2);
    }
  }
  return squares.cwiseSqrt();
}

}  // namespace rvbench::bench
