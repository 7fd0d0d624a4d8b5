#include "hal/can/can_torque_sensor.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "hal/types/units.hpp"
#include "tests/hal/can_bench.hpp"

using namespace rvbench;

namespace {

constexpr double rate_Hz = test::CanBench::rate_Hz;
constexpr double deadline_s = 0.2;
constexpr double count_rad = units::two_pi / 65536;

struct Bench {
  Bench() {
    world.brake.set_fault(sim::NodeFault::silent);  // no frames but the transducer's
    REQUIRE(sensor.connect());
  }

  void wait_until(double time_s) { world.wait_until(time_s); }
  double newest_sample_s() const { return std::floor(world.now_s() * rate_Hz + 1e-6) / rate_Hz; }

  test::CanBench world;
  hal::CanTorqueSensor sensor{
      std::move(world.bus.bench), {.rate_Hz = rate_Hz, .deadline_s = deadline_s}, world};
};

// An adapter that is held up for a while, and then hands on at once all that has come.
class HeldTransport final : public hal::CanTransport {
 public:
  HeldTransport(std::unique_ptr<hal::CanTransport> bus, const hal::Clock& clock)
      : bus_(std::move(bus)), clock_(clock) {}
  Status open() override { return bus_->open(); }
  Status send(const hal::CanFrame& frame) override { return bus_->send(frame); }
  Result<hal::CanFrame> receive() override {
    if (clock_.now_s() < held_until_s) return IoError{IoErrc::timeout, "held"};
    auto frame = bus_->receive();
    if (!frame) return frame;
    hal::CanFrame late = frame.value();
    late.time_s = std::max(late.time_s, held_until_s);
    return late;
  }

  double held_until_s = 0;

 private:
  std::unique_ptr<hal::CanTransport> bus_;
  const hal::Clock& clock_;
};

// Behind it, at 0.1 s, and what had come by then has been read.
struct HeldBench {
  HeldBench() {
    world.brake.set_fault(sim::NodeFault::silent);
    REQUIRE(sensor.connect());
    world.wait_until(0.1);
    REQUIRE(sensor.read());
  }

  test::CanBench world;
  std::unique_ptr<HeldTransport> held =
      std::make_unique<HeldTransport>(std::move(world.bus.bench), world);
  HeldTransport& transport = *held;
  hal::CanTorqueSensor sensor{std::move(held), {.rate_Hz = rate_Hz, .deadline_s = 2}, world};
};

int count_nan(const hal::TorqueBlock& block) {
  int lost = 0;
  for (const auto& sample : block.samples) lost += std::isnan(sample.torque_Nm) ? 1 : 0;
  return lost;
}

}  // namespace

SCENARIO("torque and angle arrive as the transducer has them", "[hal][can]") {
  Bench bench;
  WHEN("the shaft turns at 3000 rpm for a second") {
    bench.wait_until(0.1);
    REQUIRE(bench.sensor.read());
    std::size_t samples = 0;
    hal::TorqueSample last;
    for (int i = 2; i <= 11; ++i) {
      bench.wait_until(0.1 * i);
      const auto block = bench.sensor.read();
      REQUIRE(block);
      CHECK(block.value().lost == 0);
      samples += block.value().samples.size();
      last = block.value().samples.back();
    }
    THEN("all samples are there") { CHECK(samples == 500); }
    THEN("the torque is right to a µN·m") {
      CHECK(last.torque_Nm == Approx(test::CanBench::torque_Nm).margin(1e-6).epsilon(0));
    }
    THEN("the angle is unwrapped over 55 turns, to one count") {
      const double angle_rad = test::CanBench::angle_rad(bench.newest_sample_s());
      CHECK(last.angle_rad == Approx(angle_rad).margin(1.01 * count_rad).epsilon(0));
      CHECK(last.angle_rad > 54.9 * units::two_pi);
    }
  }
  WHEN("nothing new has come since the last call") {
    const double now_s = bench.world.now_s();
    const auto block = bench.sensor.read();
    THEN("read says so at once, with an empty block") {
      REQUIRE(block);
      CHECK(block.value().samples.empty());
      CHECK(bench.world.now_s() == now_s);
    }
  }
}

SCENARIO("lost frames become NaN, in their place and counted", "[hal][can]") {
  Bench bench;
  bench.wait_until(0.1);
  REQUIRE(bench.sensor.read());
  const int lost = GENERATE(1, 7, 90, 255, 256, 300, 700);
  bench.world.transducer.lose_frames(lost);
  bench.wait_until(0.1 + (lost + 10) / rate_Hz);
  const auto block = bench.sensor.read();
  REQUIRE(block);
  CHECK(block.value().lost == lost);
  CHECK(count_nan(block.value()) == lost);
  CHECK(block.value().samples.size() == static_cast<std::size_t>(lost) + 10);
  CHECK_FALSE(std::isnan(block.value().samples.back().torque_Nm));
  THEN("the angle goes on through the gap without losing a turn") {
    const double angle_rad = test::CanBench::angle_rad(bench.newest_sample_s());
    CHECK(block.value().samples.back().angle_rad ==
          Approx(angle_rad).margin(1.01 * count_rad).epsilon(0));
  }
}

TEST_CASE("a transducer that is slower than it says loses nothing by it", "[hal][can]") {
  const double slower = GENERATE(0.98, 0.96);
  test::CanBench world;
  world.brake.set_fault(sim::NodeFault::silent);
  hal::CanTorqueSensor sensor{
      std::move(world.bus.bench), {.rate_Hz = rate_Hz / slower, .deadline_s = deadline_s}, world};
  REQUIRE(sensor.connect());
  std::size_t samples = 1;
  int lost = 0;
  for (int i = 1; i <= 1500; ++i) {
    world.wait_until(0.1 * i);
    const auto block = sensor.read();
    REQUIRE(block);
    samples += block.value().samples.size();
    lost += block.value().lost;
  }
  CHECK(lost == 0);
  CHECK(double(samples) == Approx(150 * rate_Hz).margin(2));
}

TEST_CASE("frames that come late in a burst are not lost", "[hal][can]") {
  HeldBench bench;
  const int periods = GENERATE(10, 127, 130, 200, 239);
  const bool has_loss = GENERATE(false, true);  // of frames that came when they should not have
  if (has_loss) bench.world.transducer.lose_frames(5);
  bench.transport.held_until_s = 0.1 + periods / rate_Hz;
  std::size_t samples = 0;
  int lost = 0;
  for (int i = 0; i < 100; ++i) {
    bench.world.wait_until(0.1 + i * 0.01);
    const auto block = bench.sensor.read();
    REQUIRE(block);
    samples += block.value().samples.size();
    lost += block.value().lost;
  }
  CHECK(lost == (has_loss ? 5 : 0));
  CHECK(double(samples) == Approx(0.99 * rate_Hz).margin(1));
}

TEST_CASE(
    "a burst that was held up for longer than its counter goes round leaves no trace but a "
    "count of lost samples",
    "[hal][can]") {
  HeldBench bench;
  bench.transport.held_until_s = 0.1 + 300 / rate_Hz;
  std::size_t samples = 0;
  hal::TorqueBlock newest;
  for (int i = 0; i < 200; ++i) {
    bench.world.wait_until(0.1 + i * 0.01);
    const auto block = bench.sensor.read();
    REQUIRE(block);
    samples += block.value().samples.size();
    if (!block.value().samples.empty()) newest = block.value();
  }
  CHECK(double(samples) == Approx(1.99 * rate_Hz).margin(1));
  const double newest_s = newest.t0_s + double(newest.samples.size() - 1) / rate_Hz;
  CHECK(newest_s == Approx(bench.world.now_s()).margin(0.003));
}

SCENARIO("a transducer that says nothing new is an error, each in its own word", "[hal][can]") {
  Bench bench;
  bench.wait_until(0.1);
  REQUIRE(bench.sensor.read());
  WHEN("it falls silent") {
    bench.world.transducer.set_fault(sim::NodeFault::silent);
    bench.wait_until(0.1 + deadline_s - 0.01);
    CHECK(bench.sensor.read());
    bench.wait_until(0.1 + deadline_s + 0.01);
    const auto block = bench.sensor.read();
    THEN("that is a time-out after the deadline, not before") {
      REQUIRE_FALSE(block);
      CHECK(block.error().code == IoErrc::timeout);
    }
  }
  WHEN("it sends its last frame again and again") {
    bench.world.transducer.set_fault(sim::NodeFault::frozen);
    const double between_s = GENERATE(0.01, 0.15, 5.0);
    THEN("that is stale after the deadline, however often and long it is asked") {
      for (double time_s = 0.1 + between_s; time_s < 12; time_s += between_s) {
        bench.wait_until(time_s);
        const auto block = bench.sensor.read();
        if (time_s < 0.1 + deadline_s + 0.005) continue;
        REQUIRE_FALSE(block);
        CHECK(block.error().code == IoErrc::stale);
      }
    }
  }
  WHEN("what waits is older than the deadline, because nothing came since") {
    bench.wait_until(0.15);
    bench.world.transducer.set_fault(sim::NodeFault::silent);
    bench.wait_until(1);
    const auto block = bench.sensor.read();
    THEN("it is not taken for fresh") {
      REQUIRE_FALSE(block);
      CHECK(block.error().code == IoErrc::timeout);
    }
  }
}

SCENARIO("a transducer that sends what is no value is told from one that repeats", "[hal][can]") {
  Bench bench;
  bench.wait_until(0.1);
  REQUIRE(bench.sensor.read());
  WHEN("it sends each frame twice") {
    bench.world.transducer.set_fault(sim::NodeFault::duplicated);
    bench.wait_until(0.2);
    THEN("each counts once") {
      const auto block = bench.sensor.read();
      REQUIRE(block);
      CHECK(block.value().samples.size() == 50);
      CHECK(block.value().lost == 0);
    }
  }
  WHEN("a frame has the wrong length") {
    bench.world.transducer.set_fault(sim::NodeFault::garbled);
    bench.wait_until(0.11);
    const auto block = bench.sensor.read();
    REQUIRE_FALSE(block);
    CHECK(block.error().code == IoErrc::bad_reply);
  }
  WHEN("it is being zeroed, overloaded or has its shunt on") {
    bench.world.transducer.set_flags(GENERATE(sim::TransducerFlags{.zeroing = true},
                                              sim::TransducerFlags{.overload = true},
                                              sim::TransducerFlags{.shunt_on = true}));
    bench.wait_until(0.11);
    const auto block = bench.sensor.read();
    THEN("its values are not passed on; afterwards they count as lost") {
      REQUIRE_FALSE(block);
      CHECK(block.error().code == IoErrc::bad_reply);
      bench.world.transducer.set_flags({});
      bench.wait_until(0.15);
      const auto next = bench.sensor.read();
      REQUIRE(next);
      CHECK(next.value().lost == 5);
    }
  }
}

TEST_CASE("a transducer that never answers is found at connect", "[hal][can]") {
  test::CanBench world;
  world.transducer.set_fault(sim::NodeFault::silent);
  world.brake.set_fault(sim::NodeFault::silent);
  hal::CanTorqueSensor sensor(std::move(world.bus.bench), {.rate_Hz = rate_Hz, .deadline_s = 0.2},
                              world);
  const auto connected = sensor.connect();
  REQUIRE_FALSE(connected);
  CHECK(connected.error().code == IoErrc::timeout);
  CHECK(sensor.read().error().code == IoErrc::disconnected);
}

TEST_CASE("a torque sensor without rate, deadline or transport is the caller's bug", "[hal][can]") {
  test::CanBench world;
  CHECK_THROWS_AS(hal::CanTorqueSensor(nullptr, {}, world), std::invalid_argument);
  CHECK_THROWS_AS(hal::CanTorqueSensor(std::move(world.bus.bench), {.rate_Hz = 0}, world),
                  std::invalid_argument);
  test::CanBench other;
  CHECK_THROWS_AS(hal::CanTorqueSensor(std::move(other.bus.bench), {.deadline_s = NAN}, other),
                  std::invalid_argument);
}
