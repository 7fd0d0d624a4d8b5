#include <algorithm>
#include <cmath>

#include "bench/qualification/self_test_steps.hpp"
#include "bench/qualification/sensors_at_rest.hpp"

namespace rvbench::bench {
namespace {

constexpr double before_s = 0.5;
constexpr double ask_again_s = 5;
constexpr double times_noise = 8;  // normal noise reaches it once in 10^15 samples

/// Somebody taps on the housing, and every accelerometer must show it: one that is loose, or whose
/// cable is off, shows its noise alone, which at rest looks better than that of a sound one.
///
/// A sensor across the blow may show little: so taps may come from several sides, as long as the
/// step waits.
class Tap final : public SelfTestStep {
 public:
  std::string_view name() const override { return tap_step; }

  sequences::Segment segment(const SelfTestSpec& spec) const override {
    return {"wait for taps on the housing", before_s + spec.tap_timeout_s, 0, 0, false};
  }

  std::optional<Ending> run(sequences::BenchLoop& loop, const SelfTestSpec& spec,
                            SelfTestResult& result) override {
    std::vector<SensorAtRest> before = sensors_of(loop.rig());
    if (auto ending = listen_at_rest(loop, before_s, before).ending) return ending;
    before.pop_back();  // no tap shows in the torque: the brake's step asks that transducer
    for (const SensorAtRest& sensor : before) {
      const double least = std::max(spec.tap_m_s2, times_noise * sensor.rms());
      result.readings.push_back(at_least(sensor.name, 0, least, sensor.unit));
    }
    const sequences::Waited waited = wait_for_taps(loop, spec.tap_timeout_s, before, result);
    if (waited.ending) return waited.ending;
    tell(result, spec.tap_timeout_s);
    return std::nullopt;
  }

 private:
  static sequences::Waited wait_for_taps(sequences::BenchLoop& loop, double timeout_s,
                                         const std::vector<SensorAtRest>& before,
                                         SelfTestResult& result) {
    double ask_s = loop.now_s();
    const auto are_all_seen = [&](const sequences::BenchValues&) {
      take_peaks(loop.devices().fresh(), before, result.readings);
      if (std::ranges::all_of(result.readings, [](const SelfTestReading& reading) {
            return reading.word == SelfTestWord::passed;
          })) {
        return true;
      }
      if (loop.now_s() >= ask_s) {
        loop.event("tap on the housing now, from several sides");
        if (loop.rig().tap_housing) loop.rig().tap_housing();
        ask_s = loop.now_s() + ask_again_s;
      }
      return false;
    };
    return loop.run_until(are_all_seen, timeout_s);
  }

  static void take_peaks(const sequences::FreshValues& fresh,
                         const std::vector<SensorAtRest>& before,
                         std::vector<SelfTestReading>& readings) {
    if (!fresh.accelerations) return;
    const auto& scans = fresh.accelerations->scans;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      SelfTestReading& reading = readings[i];
      double peak = reading.value;
      for (const float value : scans.col(static_cast<Eigen::Index>(i))) {
        const double off = std::abs(double(value) - before[i].mean);
        if (off > peak) peak = off;  // false of a lost one, NaN
      }
      reading = at_least(reading.of, peak, reading.limit, reading.unit);
    }
  }

  static void tell(SelfTestResult& result, double timeout_s) {
    conclude(result, "peak of the taps");
    if (std::ranges::none_of(result.readings, [](const SelfTestReading& reading) {
          return reading.word == SelfTestWord::passed;
        })) {
      result.word = SelfTestWord::cannot_tell;
      result.reason = "no accelerometer has shown a tap within " +
                      std::to_string(static_cast<int>(timeout_s)) +
                      " s: nobody tapped, or none "
                      "of them is fixed to the housing";
    } else if (result.word == SelfTestWord::failed) {
      result.reason += ": others show the taps, so it is loose, or its cable is";
    }
  }
};

}  // namespace

std::unique_ptr<SelfTestStep> make_tap() { return std::make_unique<Tap>(); }

}  // namespace rvbench::bench
