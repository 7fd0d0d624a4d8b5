#include "bench/qualification/self_test.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "hal/simulated_rig.hpp"
#include "hal/types/units.hpp"
#include "sim/bench_world.hpp"
#include "tests/bench/spoilt_devices.hpp"

namespace rvbench::bench {

using Catch::Matchers::Contains;

namespace {

using Words = std::map<std::string, std::string>;

const Words all_pass{{"sensor_noise", "pass"},
                     {"sensor_bias", "pass"},
                     {"tap", "pass"},
                     {"drive_read_back", "pass"},
                     {"brake_read_back", "pass"}};

Words all_pass_but(const Words& others) {
  Words words = all_pass;
  for (const auto& [step, word] : others) words[step] = word;
  return words;
}

struct Told final : sequences::RunObserver {
  std::vector<std::string> events;
  std::function<void(const std::string&)> at_event = [](const std::string&) {};
  void progress(double, double, const std::string&) override {}
  void event(double, const std::string& text) override {
    events.push_back(text);
    at_event(text);
  }
};

// A simulated station over its real wires, which a test may spoil before it is tested.
class StationBench {
 public:
  explicit StationBench(std::uint64_t seed = 1) : StationBench(sim::draw_unit("healthy", seed)) {}
  explicit StationBench(const sim::RvUnit& unit) {
    auto made = std::make_unique<sim::BenchWorld>(unit);
    world = made.get();
    const hal::SimulatedRigOptions options{.torque_rate_Hz = world->transducer().rate_Hz()};
    rig = hal::make_simulated_rig(std::move(made), options);
    rig.tap_housing = [this] { world->tap_housing(); };
  }

  void spoil_scans(test::SpoiltAccelerometers::Spoil spoil) {
    rig.accelerometers = std::make_unique<test::SpoiltAccelerometers>(std::move(rig.accelerometers),
                                                                      std::move(spoil));
  }

  const SelfTest& go(bool with_tap = true) {
    result = run_self_test(spec, with_tap, rig, told, stop.get_token());
    return result;
  }

  Words words() const {
    Words words;
    for (const SelfTestResult& step : result.steps) words[step.step] = to_string(step.word);
    return words;
  }

  const SelfTestResult& step(const std::string& name) const {
    const auto found = std::ranges::find(result.steps, name, &SelfTestResult::step);
    REQUIRE(found != result.steps.end());
    return *found;
  }

  // In the plant itself, not by what is reported.
  void check_at_rest() const {
    CHECK(std::abs(units::rpm_from_rad_s(world->plant().motor_speed_rad_s())) < 1);
    CHECK_FALSE(world->inverter().output_enabled());
    CHECK_FALSE(world->brake().engaged());
  }

  sim::BenchWorld* world = nullptr;
  hal::Rig rig;
  SelfTestSpec spec;
  Told told;
  std::stop_source stop;
  SelfTest result;
};

}  // namespace

TEST_CASE("a sound station passes its self-test, whatever unit is on it", "[bench][station]") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    StationBench bench(seed);
    CAPTURE(seed, bench.go().reason(bench.spec));
    CHECK(bench.words() == all_pass);
    CHECK(bench.result.passed(bench.spec));
    CHECK(bench.result.reason(bench.spec) == "every step passed");
    bench.check_at_rest();
    // Twelve accelerometers and the torque transducer.
    CHECK(bench.step("sensor_noise").readings.size() == 13);
    CHECK(bench.step("tap").readings.size() == 12);
  }
}

TEST_CASE("a noisy sensor fails by its noise alone, and is named", "[bench][station]") {
  StationBench bench;
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, 0.3F);
  bench.spoil_scans([&](auto& scans) {
    for (Eigen::Index row = 0; row < scans.rows(); ++row) scans(row, 3) += noise(random);
  });
  CAPTURE(bench.go().reason(bench.spec));
  CHECK(bench.words() == all_pass_but({{"sensor_noise", "fail"}}));
  CHECK_FALSE(bench.result.passed(bench.spec));
  CHECK_THAT(bench.step("sensor_noise").reason,
             Contains("accel_2x") && Contains("at most 0.1") && !Contains("accel_1x"));
  bench.check_at_rest();
}

TEST_CASE("a sensor that sits beside its zero fails by its bias alone", "[bench][station]") {
  StationBench bench;
  bench.spoil_scans([](auto& scans) { scans.col(4).array() += 20; });
  CAPTURE(bench.go().reason(bench.spec));
  CHECK(bench.words() == all_pass_but({{"sensor_bias", "fail"}}));
  CHECK_THAT(bench.step("sensor_bias").reason, Contains("accel_2y 20 m/s², at most 5"));
}

TEST_CASE("a dead sensor has no noise and no bias, and is found all the same", "[bench][station]") {
  StationBench bench;
  bench.spoil_scans([](auto& scans) { scans.col(0).setZero(); });
  bench.go();
  // Nor does it show a tap.
  CHECK(bench.words() == all_pass_but({{"sensor_bias", "fail"}, {"tap", "fail"}}));
  CHECK_THAT(bench.step("sensor_bias").reason, Contains("dead, it never moves: accel_1x;"));
}

TEST_CASE("a loose sensor is told by the tap that the others show", "[bench][station]") {
  sim::RvUnit unit = sim::draw_unit("healthy", 1);
  unit.sensor_gains[5] = 0.001;  // its own noise stays
  StationBench bench(unit);
  CAPTURE(bench.go().reason(bench.spec));
  CHECK(bench.words() == all_pass_but({{"tap", "fail"}}));
  CHECK_THAT(bench.step("tap").reason,
             Contains("accel_2z") && !Contains("accel_1x") && Contains("loose"));
}

TEST_CASE("where nobody taps nothing can be told, and a tap that is left out is missing",
          "[bench][station]") {
  StationBench bench;
  bench.rig.tap_housing = nullptr;
  bench.spec.tap_timeout_s = 2;
  bench.go();
  CHECK(bench.words() == all_pass_but({{"tap", "cannot tell"}}));
  CHECK_FALSE(bench.result.passed(bench.spec));
  CHECK_THAT(bench.result.reason(bench.spec), Contains("nobody tapped"));
  CHECK(std::ranges::count(bench.told.events, "tap on the housing now, from several sides") == 1);

  StationBench alone;
  alone.go(false);
  CHECK(alone.words() == all_pass_but({{"tap", "skipped"}}));
  CHECK_FALSE(alone.result.passed(alone.spec));

  StationBench unasked;
  unasked.spec.tap = false;
  unasked.go();
  CHECK(unasked.words() == all_pass_but({{"tap", "skipped"}}));
  CHECK(unasked.result.passed(unasked.spec));
}

TEST_CASE("a drive that does not follow fails, by the angle and by its own word",
          "[bench][station]") {
  StationBench bench;
  bench.rig.drive = std::make_unique<test::SpoiltDrive>(std::move(bench.rig.drive), 0.8);
  CAPTURE(bench.go().reason(bench.spec));
  CHECK(bench.words() == all_pass_but({{"drive_read_back", "fail"}}));
  CHECK_THAT(bench.step("drive_read_back").reason,
             Contains("input_angle 2") && Contains("drive 2"));
  bench.check_at_rest();
}

TEST_CASE("of a brake nothing can be told while the shaft stands", "[bench][station]") {
  StationBench bench;
  bench.rig.drive = std::make_unique<test::SpoiltDrive>(std::move(bench.rig.drive), 0);
  bench.go();
  CHECK(bench.words() ==
        all_pass_but({{"drive_read_back", "fail"}, {"brake_read_back", "cannot tell"}}));
  CHECK_THAT(bench.step("brake_read_back").reason, Contains("does not turn as told"));
}

TEST_CASE("a brake that does not answer, and a transducer that is off, fail the brake's step",
          "[bench][station]") {
  StationBench slack;
  slack.rig.brake = std::make_unique<test::SpoiltBrake>(std::move(slack.rig.brake), 0);
  CAPTURE(slack.go().reason(slack.spec));
  CHECK(slack.words() == all_pass_but({{"brake_read_back", "fail"}}));
  CHECK_THAT(slack.step("brake_read_back").reason,
             Contains("input_torque 100 %") && Contains("the brake told 1."));

  StationBench reversed;
  reversed.rig.torque_sensor =
      std::make_unique<test::SpoiltTorqueSensor>(std::move(reversed.rig.torque_sensor), -1);
  CAPTURE(reversed.go().reason(reversed.spec));
  CHECK(reversed.words() == all_pass_but({{"brake_read_back", "fail"}}));
  CHECK_THAT(reversed.step("brake_read_back").reason,
             Contains("input_torque") && !Contains("brake 0"));
}

TEST_CASE("a device that is lost ends the self-test as an ERROR, with the shaft stopped",
          "[bench][station][safety]") {
  StationBench bench;
  bench.told.at_event = [&](const std::string& text) {
    if (text == "drive_read_back: pass") {
      bench.world->transducer().set_fault(sim::NodeFault::silent);
    }
  };
  bench.go();
  CHECK(bench.result.ending.error_kind == ErrorKind::device_lost);
  CHECK(bench.words() == all_pass_but({{"brake_read_back", "cannot tell"}}));
  CHECK_THAT(bench.step("brake_read_back").reason, Contains("did not come to its end"));
  CHECK_FALSE(bench.result.passed(bench.spec));
  bench.check_at_rest();
}

TEST_CASE("above what the rig file allows the shaft is stopped", "[bench][station][safety]") {
  const auto check_stopped = [](double SelfTestSpec::*limit, double allowed,
                                const std::string& named) {
    StationBench bench;
    bench.spec.*limit = allowed;
    bench.go();
    CAPTURE(named, bench.result.ending.reason);
    CHECK(bench.result.ending.error_kind == ErrorKind::safety_trip);
    CHECK_THAT(bench.result.ending.reason, Contains(named));
    CHECK_FALSE(bench.result.passed(bench.spec));
    bench.check_at_rest();
  };
  check_stopped(&SelfTestSpec::most_input_torque_Nm, 0.1, "input torque");
  check_stopped(&SelfTestSpec::most_acceleration_m_s2, 0.2, "acceleration");
  check_stopped(&SelfTestSpec::most_housing_temp_degC, 10, "temperature");
}

TEST_CASE("a self-test that is stopped stops the shaft, and steps not reached say so",
          "[bench][station][safety]") {
  StationBench bench;
  bench.told.at_event = [&](const std::string& text) {
    if (text == "tap: pass") {
      bench.world->at(bench.world->now_s() + 5, [&] { bench.stop.request_stop(); });
    }
  };
  bench.go();
  CHECK(bench.result.ending.outcome == Outcome::aborted);
  CHECK(bench.step("brake_read_back").reason == "it was not reached");
  bench.check_at_rest();
}

TEST_CASE("a self-test that a rig cannot do is refused beforehand", "[bench][station]") {
  StationBench bench;
  CHECK(why_not_on(bench.rig, bench.spec).empty());
  bench.spec.brake_torque_Nm = 700;
  CHECK_THAT(why_not_on(bench.rig, bench.spec), Contains("700 N·m, the brake can do 600"));
}

}  // namespace rvbench::bench
