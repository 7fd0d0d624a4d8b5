#include "bench/qualification/sensors_at_rest.hpp"

#include <algorithm>
#include <cmath>

namespace rvbench::bench {

void SensorAtRest::take(double value) {
  if (!std::isfinite(value)) {
    ++lost;
    return;
  }
  ++samples;
  const double off = value - mean;
  mean += off / double(samples);
  squares += off * (value - mean);
  least = samples == 1 ? value : std::min(least, value);
  most = samples == 1 ? value : std::max(most, value);
}

double SensorAtRest::rms() const {
  return samples < 2 ? not_known : std::sqrt(squares / double(samples));
}

std::vector<SensorAtRest> sensors_of(const hal::Rig& rig) {
  std::vector<SensorAtRest> sensors;
  for (const ChannelInfo& channel : rig.accelerometers->channels()) {
    sensors.push_back({channel.name, channel.unit});
  }
  sensors.push_back({std::string(channel_names::input_torque), "N·m"});
  return sensors;
}

void take_fresh(std::vector<SensorAtRest>& sensors, const sequences::FreshValues& fresh) {
  if (fresh.accelerations) {
    const auto& scans = fresh.accelerations->scans;
    for (Eigen::Index row = 0; row < scans.rows(); ++row) {
      for (Eigen::Index column = 0; column < scans.cols(); ++column) {
        sensors[static_cast<std::size_t>(column)].take(double(scans(row, column)));
      }
    }
  }
  if (fresh.torque) {
    for (const hal::TorqueSample& sample : fresh.torque->samples) {
      sensors.back().take(sample.torque_Nm);
    }
  }
}

sequences::Waited listen_at_rest(sequences::BenchLoop& loop, double duration_s,
                                 std::vector<SensorAtRest>& sensors) {
  loop.command(0, 0);
  return loop.run_until(
      [&](const sequences::BenchValues&) {
        take_fresh(sensors, loop.devices().fresh());
        return false;
      },
      duration_s);
}

}  // namespace rvbench::bench
