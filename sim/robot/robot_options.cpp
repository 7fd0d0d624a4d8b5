#include "sim/robot/robot_options.hpp"

#include "hal/types/require.hpp"
#include "hal/types/require_positive.hpp"

namespace rvbench::sim {

void require_sound(const RobotOptions& options) {
  constexpr Require require{"RobotOptions"};
  for (const auto& [value, name] : {std::pair{options.rate_Hz, "rate_Hz"},
                                    {options.record_s, "record_s"},
                                    {options.hit_s, "hit_s"},
                                    {options.force_range_N, "force_range_N"},
                                    {options.acceleration_range_m_s2, "acceleration_range_m_s2"}}) {
    require_positive(value, "RobotOptions", name);
  }
  for (const auto& [value, name] : {std::pair{options.sensor_noise, "sensor_noise"},
                                    {options.hit_scatter, "hit_scatter"},
                                    {options.hit_noise, "hit_noise"},
                                    {options.bad_hit_share, "bad_hit_share"}}) {
    require(value >= 0 && value <= 1, std::string(name) + " must be 0 to 1");
  }
  require(options.rate_Hz >= 2000, "rate_Hz must be at least 2000: forces reach to 1 kHz");
  require(options.record_s >= 1, "record_s must be at least 1");
  require(options.hit_s >= 0.5, "hit_s must be at least 0.5");
  require(options.hits >= 1, "hits must be at least 1");
}

Draw draw_for(const RobotOptions& options, std::string_view purpose) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a
  for (const char letter : purpose) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211ULL;
  }
  return Draw(Draw(options.seed ^ hash).seed());
}

}  // namespace rvbench::sim
