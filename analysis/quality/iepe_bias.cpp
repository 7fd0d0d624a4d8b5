#include "analysis/quality/iepe_bias.hpp"

#include <cmath>

#include "analysis/statistics.hpp"
#include "hal/types/units.hpp"

namespace rvbench::analysis {
namespace {

constexpr double far_quieter = 100;
constexpr double even = 0.25;       // 6 dB
constexpr double mostly_noise = 2;  // times the noise power
constexpr std::size_t fewest_others = 2;
constexpr double lowest_open_V = 18;
constexpr double highest_open_V = 36;
constexpr double most_sensitive = 1.1;  // V per m/s²

}  // namespace

bool hears_front_end_only(const std::vector<Heard>& channels, std::size_t one) {
  const Heard& channel = channels.at(one);
  if (channel.unit.empty() || channel.evenness < even) return false;
  if (channel.rms * channel.rms > mostly_noise * channel.noise * channel.noise) return false;
  std::vector<double> others;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (i != one && channels[i].unit == channel.unit) others.push_back(channels[i].rms);
  }
  return others.size() >= fewest_others && far_quieter * channel.rms < median(others);
}

std::optional<double> open_cable_bias_V(const Channel& channel) {
  const double per_unit = channel.info.sensitivity;
  const double per_m_s2 = channel.info.unit == "g" ? units::g_from_m_s2(per_unit) : per_unit;
  if (!(per_m_s2 > 0 && per_m_s2 <= most_sensitive)) return std::nullopt;
  const double bias_V = std::abs(channel.samples.mean() * per_unit);
  if (!(bias_V >= lowest_open_V && bias_V <= highest_open_V)) return std::nullopt;
  return bias_V;
}

}  // namespace rvbench::analysis
