#include "analysis/frf/motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "hal/types/units.hpp"

namespace rvbench::analysis {

namespace {

// By rows: translation, rotation; by columns: Motion.
constexpr std::array<std::array<const char*, 3>, 2> unit_names{
    {{"m", "m/s", "m/s²"}, {"rad", "rad/s", "rad/s²"}}};

struct MotionUnit {
  std::size_t kind, derivative;
};

std::optional<MotionUnit> find_unit(std::string_view unit) {
  for (std::size_t kind = 0; kind < unit_names.size(); ++kind) {
    const auto found = std::ranges::find(unit_names[kind], unit);
    if (found != unit_names[kind].end()) {
      return MotionUnit{kind, std::size_t(found - unit_names[kind].begin())};
    }
  }
  return std::nullopt;
}

std::complex<double> factor(double frequency_Hz, int derivatives) {
  if (frequency_Hz == 0) return derivatives < 0 ? std::nan("") : derivatives > 0 ? 0.0 : 1.0;
  const std::complex<double> j_omega(0, units::two_pi * frequency_Hz);
  std::complex<double> product = 1;
  for (int i = 0; i < std::abs(derivatives); ++i) product *= j_omega;
  return derivatives < 0 ? 1.0 / product : product;
}

}  // namespace

std::optional<Motion> motion_of(std::string_view unit) {
  const auto found = find_unit(unit);
  if (!found) return std::nullopt;
  return static_cast<Motion>(found->derivative);
}

std::optional<FrequencyResponse> as_motion(const FrequencyResponse& response, Motion motion) {
  const auto from = find_unit(response.response_unit);
  if (!from) return std::nullopt;
  const int derivatives = static_cast<int>(motion) - static_cast<int>(from->derivative);
  FrequencyResponse converted = response;
  converted.response_unit = unit_names[from->kind][static_cast<std::size_t>(motion)];
  for (Eigen::Index k = 0; k < converted.values.size(); ++k) {
    converted.values[k] *= factor(converted.frequency_Hz(k), derivatives);
  }
  if (derivatives < 0 && converted.first_Hz == 0 && converted.values.size() > 0) {
    converted.values[0] = std::nan("");
    converted.notes.push_back("not known at 0 Hz: an integral of " + response.response_unit);
  }
  return converted;
}

std::optional<EstimatedResponse> as_motion(const EstimatedResponse& estimate, Motion motion) {
  const auto from = motion_of(estimate.response.response_unit);
  auto converted = as_motion(estimate.response, motion);
  if (!converted) return std::nullopt;
  EstimatedResponse result = estimate;
  const int derivatives = static_cast<int>(motion) - static_cast<int>(*from);
  for (Eigen::Index k = 0; k < result.standard_error.size(); ++k) {
    result.standard_error[k] *= std::abs(factor(converted->frequency_Hz(k), derivatives));
  }
  result.response = std::move(*converted);
  return result;
}

}  // namespace rvbench::analysis
