#include "bench/qualification/self_test_steps.hpp"
#include "bench/qualification/sensors_at_rest.hpp"

namespace rvbench::bench {
namespace {

/// What each sensor shows about its mean while nothing turns: its own noise, that of cable and
/// converter, and what the floor brings.
class SensorNoise final : public SelfTestStep {
 public:
  std::string_view name() const override { return "sensor_noise"; }

  sequences::Segment segment(const SelfTestSpec& spec) const override {
    return {"listen to the sensors at rest", spec.rest_s, 0, 0, false};
  }

  std::optional<Ending> run(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                            SelfTestResult& result) override {
    std::vector<SensorAtRest> sensors = sensors_of(loop.rig());
    if (auto ending = listen_at_rest(loop, spec.rest_s, sensors).ending) return ending;
    for (const SensorAtRest& sensor : sensors) {
      const bool is_torque = &sensor == &sensors.back();
      result.readings.push_back(at_most(sensor.name, sensor.rms(),
                                        is_torque ? spec.noise_Nm : spec.noise_m_s2, sensor.unit));
    }
    conclude(result, "noise at rest, rms");
    return std::nullopt;
  }
};

}  // namespace

std::unique_ptr<SelfTestStep> make_sensor_noise() { return std::make_unique<SensorNoise>(); }

}  // namespace rvbench::bench
