#include <cmath>

#include "bench/qualification/self_test_steps.hpp"
#include "bench/qualification/sensors_at_rest.hpp"

namespace rvbench::bench {
namespace {

/// The mean of each sensor while nothing turns. A sensor whose supply or cable has failed sits at
/// one end of its range; one that never moves at all is dead, whatever it shows.
class SensorBias final : public SelfTestStep {
 public:
  std::string_view name() const override { return "sensor_bias"; }

  sequences::Segment segment(const SelfTestSpec& spec) const override {
    return {"look for bias at rest", spec.rest_s, 0, 0, false};
  }

  std::optional<Ending> run(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                            SelfTestResult& result) override {
    std::vector<SensorAtRest> sensors = sensors_of(loop.rig());
    if (auto ending = listen_at_rest(loop, spec.rest_s, sensors).ending) return ending;
    std::string dead;
    for (const SensorAtRest& sensor : sensors) {
      const bool is_torque = &sensor == &sensors.back();
      const double mean = sensor.samples > 0 ? std::abs(sensor.mean) : not_known;
      result.readings.push_back(
          at_most(sensor.name, mean, is_torque ? spec.bias_Nm : spec.bias_m_s2, sensor.unit));
      if (!sensor.is_dead()) continue;
      result.readings.back().word = SelfTestWord::failed;
      dead += (dead.empty() ? "" : ", ") + sensor.name;
    }
    conclude(result, "mean at rest");
    if (!dead.empty()) result.reason = "dead, it never moves: " + dead + "; " + result.reason;
    return std::nullopt;
  }
};

}  // namespace

std::unique_ptr<SelfTestStep> make_sensor_bias() { return std::make_unique<SensorBias>(); }

}  // namespace rvbench::bench
