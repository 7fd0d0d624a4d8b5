#include "sequences/field_devices.hpp"

#include <catch2/catch.hpp>
#include <memory>

#include "hal/mirror_rig.hpp"

using namespace rvbench;

namespace {

// Safety inputs and a brake that say since when they know what they say.
class DatedInputs final : public hal::SafetyInputs {
 public:
  explicit DatedInputs(const double& time_s) : time_s_(time_s) {}
  Status connect() override { return Done{}; }
  Result<hal::SafetyStatus> read() override { return hal::SafetyStatus{false, false, 25, time_s_}; }

 private:
  const double& time_s_;
};

class DatedBrake final : public hal::Brake {
 public:
  explicit DatedBrake(const double& time_s) : time_s_(time_s) {}
  hal::BrakeLimits limits() const override { return {.max_torque_Nm = 400}; }
  Status connect() override { return Done{}; }
  Status set_torque(double) override { return Done{}; }
  Result<hal::BrakeStatus> read() override { return hal::BrakeStatus{70, false, time_s_}; }
  Status release() noexcept override { return Done{}; }

 private:
  const double& time_s_;
};

struct Watched {
  Watched() {
    rig.safety = std::make_unique<DatedInputs>(known_s);
    rig.brake = std::make_unique<DatedBrake>(known_s);
    REQUIRE(rig.torque_sensor->connect());
    REQUIRE(rig.accelerometers->connect());
    REQUIRE(rig.accelerometers->start());
    known_s = rig.clock->now_s();
    field.start();
  }
  // Reads as often as the supervisor does.
  void read_for(double duration_s) {
    const double until_s = rig.clock->now_s() + duration_s;
    while (rig.clock->now_s() < until_s) {
      rig.clock->wait_until(rig.clock->now_s() + 0.001);
      (void)field.read();
      field.hold_brake(70);
    }
  }

  double known_s = not_known;
  hal::Rig rig = hal::make_mirror_rig({});
  sequences::FieldDevices field{rig};
};

}  // namespace

TEST_CASE("a value that a device holds grows old, though it is read again and again",
          "[sequences][safety]") {
  Watched watched;
  watched.read_for(0.29);
  CHECK(watched.field.lost(0.3).empty());
  watched.read_for(0.02);
  CHECK_THAT(watched.field.lost(0.3), Catch::Contains("safety inputs silent for 0.31 s") &&
                                          Catch::Contains("brake silent for 0.31 s"));
}

TEST_CASE("a value without a time is as new as its reading", "[sequences][safety]") {
  Watched watched;
  watched.known_s = not_known;
  watched.read_for(1);
  CHECK(watched.field.lost(0.3).empty());
}

TEST_CASE("a value from before the watch is no answer", "[sequences][safety]") {
  Watched watched;
  watched.read_for(0.1);
  CHECK_FALSE(watched.field.all_answered());
  watched.known_s = watched.rig.clock->now_s();
  watched.read_for(0.1);
  CHECK(watched.field.all_answered());
}
