#include "analysis/envelope/tested_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/statistics.hpp"
#include "hal/types/require.hpp"

namespace rvbench::analysis {

namespace {

constexpr double tail_share = 0.1;  // of the lines, whose powers tell how the others fall off

double p_of_ratio(const TestedSpectrum& t, Eigen::Index line, double ratio) {
  const double p = line_p_value(t.averages * ratio, t.averages, t.floor_lines[line]);
  if (!(t.tail_scale > 0)) return p;
  const double beyond = std::max(0.0, (ratio - t.tail_from) / t.tail_scale);
  return std::max(p, tail_share * line_p_value(beyond, 1, t.tail_lines));
}

}  // namespace

double TestedSpectrum::p_value(Eigen::Index line) const {
  const double power = spectrum.amplitude[line] * spectrum.amplitude[line];
  return p_of_ratio(*this, line, power / noise[line]);
}

double TestedSpectrum::threshold(Eigen::Index line, double rate) const {
  constexpr Require require{"TestedSpectrum::threshold"};
  require(rate > 0 && rate < 1, "rate must be within 0 and 1");
  double low = 0, high = 1;
  while (p_of_ratio(*this, line, high) > rate) high *= 2;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (p_of_ratio(*this, line, middle) > rate ? low : high) = middle;
  }
  return std::sqrt(high * noise[line]);
}

double TestedSpectrum::rate_of_one_line(double rate) const {
  const auto lines = double(std::max<Eigen::Index>(last - first + 1, 1));
  return -std::expm1(std::log1p(-rate) / lines);
}

std::vector<Eigen::Index> TestedSpectrum::significant(double rate) const {
  const double of_one = rate_of_one_line(rate);
  std::vector<Eigen::Index> lines;
  for (Eigen::Index line = first; line <= last; ++line) {
    if (p_value(line) < of_one) lines.push_back(line);
  }
  return lines;
}

TestedSpectrum tested_against_floor(Spectrum envelope, Eigen::Index last,
                                    const Eigen::VectorXd& shape) {
  constexpr Eigen::Index of_hann = 2;  // line 1 holds what drifts
  Spectrum even = envelope;
  if (shape.size() > 0) even.amplitude.array() /= shape.array().sqrt();
  LineFloor floor = line_floor(even, 0);
  TestedSpectrum tested;
  tested.first = of_hann;
  tested.last = std::min(last, envelope.amplitude.size() - 2);
  tested.spectrum = std::move(envelope);
  tested.noise = std::move(floor.floor);
  if (shape.size() > 0) tested.noise.array() *= shape.array();
  tested.floor_lines = std::move(floor.floor_lines);
  return tested;
}

LineEvidence evidence_near(const TestedSpectrum& tested, double frequency, double within,
                           double rate) {
  const double step = tested.spectrum.resolution;
  const auto nearest = static_cast<Eigen::Index>(std::lround(frequency / step));
  const auto low = static_cast<Eigen::Index>(std::ceil((frequency - within) / step));
  const auto high = static_cast<Eigen::Index>(std::floor((frequency + within) / step));
  const Eigen::Index from = std::max(std::min(low, nearest), tested.first);
  const Eigen::Index to = std::min(std::max(high, nearest), tested.last);
  if (from > to) return {frequency};

  const auto ratio = [&](Eigen::Index line) {
    return tested.spectrum.amplitude[line] * tested.spectrum.amplitude[line] / tested.noise[line];
  };
  Eigen::Index best = from;
  for (Eigen::Index line = from + 1; line <= to; ++line) {
    if (ratio(line) > ratio(best)) best = line;
  }
  const auto looked_at = double(to - from + 1);
  return {tested.spectrum.axis(best), tested.spectrum.amplitude[best],
          tested.threshold(best, rate / looked_at),
          std::min(1.0, looked_at * tested.p_value(best))};
}

}  // namespace rvbench::analysis
